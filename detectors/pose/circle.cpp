#include <ceres/ceres.h>

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <array>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "detectors/pose/choice.h"
#include "detectors/pose/pose.h"

namespace relock::pose {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kOutlinePoints = 24;
/// An ellipse has five numbers, and so many points on it say no more.
constexpr double kPointsPerNumber = kOutlinePoints / 5.0;

/// The outline and the middle without the lens's distortion, normalised.
struct Seen {
  std::vector<Vector2d> outline;
  std::optional<Vector2d> middle;
};

Vec2 point_on(const Ellipse& ellipse, double angle) {
  const double u = ellipse.semi_major * std::cos(angle), v = ellipse.semi_minor * std::sin(angle);
  const double c = std::cos(ellipse.angle_rad), s = std::sin(ellipse.angle_rad);
  return {ellipse.centre.x + c * u - s * v, ellipse.centre.y + s * u + c * v};
}

Seen seen_of(const Camera& camera, const Sighting& sighting, const Ellipse& ellipse) {
  Seen seen;
  for (int i = 0; i < kOutlinePoints; ++i)
    seen.outline.push_back(normalised(camera, point_on(ellipse, 2 * std::numbers::pi * i / kOutlinePoints)));
  if (sighting.centre_kind == CentreKind::projected) seen.middle = normalised(camera, sighting.centre);
  return seen;
}

/// The conic x' Q x = 0 through points, x homogeneous; scaled so that two eigenvalues are above 0.
Eigen::Matrix3d conic_through(const std::vector<Vector2d>& points) {
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(points.size()), 6);
  // About their mean and as large as 1: else the squares of small numbers are lost.
  Vector2d mean = Vector2d::Zero();
  double spread = 0;
  for (const Vector2d& p : points) mean += p / static_cast<double>(points.size());
  for (const Vector2d& p : points) spread += (p - mean).norm() / static_cast<double>(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector2d p = (points[i] - mean) / spread;
    rows.row(static_cast<Eigen::Index>(i)) << p.x() * p.x(), 2 * p.x() * p.y(), p.y() * p.y(), 2 * p.x(),
        2 * p.y(), 1;
  }
  const Eigen::VectorXd q = rows.jacobiSvd(Eigen::ComputeFullV).matrixV().col(5);
  Eigen::Matrix3d conic, to_unit = Eigen::Matrix3d::Identity();
  conic << q[0], q[1], q[3], q[1], q[2], q[4], q[3], q[4], q[5];
  to_unit.topLeftCorner<2, 2>() /= spread, to_unit.topRightCorner<2, 1>() = -mean / spread;
  conic = to_unit.transpose() * conic * to_unit;
  return conic(0, 0) + conic(1, 1) < 0 ? Eigen::Matrix3d(-conic) : conic;
}

/// A circle's plane and middle.
struct Circle {
  Vector3d middle, normal;
};

/// The two circles of a radius whose image is a conic: planes that cut the cone behind it in circles (Chen, Wu and Wada
/// 2004, section 3). In the frame of its eigenvectors, with eigenvalues a >= b > 0 > c, their normals are
/// (+-sqrt((a - b) / (a - c)), 0, sqrt((b - c) / (a - c))).
std::array<Circle, 2> circles_of(const Eigen::Matrix3d& cone, double radius) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(cone);
  const double c = solver.eigenvalues()(0), b = solver.eigenvalues()(1), a = solver.eigenvalues()(2);
  Eigen::Matrix3d axes;
  axes << solver.eigenvectors().col(2), solver.eigenvectors().col(1), solver.eigenvectors().col(0);
  const double g = std::sqrt(std::max(a - b, 0.0) / (a - c)), h = std::sqrt((b - c) / (a - c));
  const double scale = b * radius / std::sqrt(-a * c);
  std::array<Circle, 2> both;
  for (std::size_t i = 0; i < 2; ++i) {
    const double side = i == 0 ? 1 : -1;
    Vector3d normal = axes * Vector3d(side * g, 0, h);
    Vector3d middle = scale * (axes * Vector3d(side * g * c / b, 0, h * a / b));
    if (middle.z() < 0) middle = -middle;
    if (normal.dot(middle) > 0) normal = -normal;
    both[i] = {middle, normal};
  }
  return both;
}

/// A normal near another: tilted by a and b along two directions across it.
struct Tilting {
  Vector3d normal, e1, e2;
  explicit Tilting(const Vector3d& n) : normal(n), e1(n.unitOrthogonal()), e2(n.cross(e1)) {}
  template <class T>
  Eigen::Matrix<T, 3, 1> tilted(const T& a, const T& b) const {
    return (normal.cast<T>() + a * e1.cast<T>() + b * e2.cast<T>()).normalized();
  }
};

/// How far points of the outline are from the image of the circle: to first order, in px over their deviation.
struct OutlineResiduals {
  const Seen& seen;
  const Tilting& tilting;
  double radius, weight;

  template <class T>
  bool operator()(const T* u, T* residuals) const {
    using V = Eigen::Matrix<T, 3, 1>;
    const V middle(u[0], u[1], u[2]), normal = tilting.tilted(u[3], u[4]);
    const T distance = normal.dot(middle);
    for (std::size_t i = 0; i < seen.outline.size(); ++i) {
      const V ray(T(seen.outline[i].x()), T(seen.outline[i].y()), T(1));
      const T along = normal.dot(ray);
      const V off = ray * (distance / along) - middle;  // where the ray meets the plane
      const T level = off.squaredNorm() - radius * radius;
      const V by_x = (V(T(1), T(0), T(0)) * along - ray * normal.x()) * (distance / (along * along));
      const V by_y = (V(T(0), T(1), T(0)) * along - ray * normal.y()) * (distance / (along * along));
      const T gx = T(2) * off.dot(by_x), gy = T(2) * off.dot(by_y);
      residuals[i] = weight * level / ceres::sqrt(gx * gx + gy * gy);
    }
    return true;
  }
};

/// How far the middle is from where it is seen. `root`: of the inverse of the centre's covariance, over normalised places.
struct MiddleResidual {
  Vector2d seen;
  Eigen::Matrix2d root;

  template <class T>
  bool operator()(const T* u, T* residuals) const {
    const Eigen::Matrix<T, 2, 1> off(u[0] / u[2] - seen.x(), u[1] / u[2] - seen.y());
    Eigen::Map<Eigen::Matrix<T, 2, 1>>(residuals, 2) = root.cast<T>() * off;
    return true;
  }
};

Pose refined(const Camera& camera, const Seen& seen, const Circle& start, double radius,
             const Accuracy& accuracy, const Eigen::Matrix2d& middle_root) {
  const Tilting tilting(start.normal);
  std::array<double, 5> u{start.middle.x(), start.middle.y(), start.middle.z(), 0, 0};
  ceres::Problem problem;
  const double weight = camera.focal_px() / (accuracy.outline_px * std::sqrt(kPointsPerNumber));
  problem.AddResidualBlock(new ceres::AutoDiffCostFunction<OutlineResiduals, kOutlinePoints, 5>(
                               new OutlineResiduals{seen, tilting, radius, weight}),
                           nullptr, u.data());
  if (seen.middle)
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<MiddleResidual, 2, 5>(new MiddleResidual{*seen.middle, middle_root}),
        nullptr, u.data());
  const Solved solved = solve(problem, u.data(), 5);
  Pose pose;
  pose.position = {u[0], u[1], u[2]};
  pose.normal = tilting.tilted(u[3], u[4]);
  pose.misfit = solved.misfit;
  // A tilt by a along e1 is a turn by a about normal x e1.
  Eigen::Matrix<double, 6, 5> turn = Eigen::Matrix<double, 6, 5>::Zero();
  turn.topLeftCorner<3, 3>().setIdentity();
  turn.block<3, 1>(3, 3) = tilting.normal.cross(tilting.e1);
  turn.block<3, 1>(3, 4) = tilting.normal.cross(tilting.e2);
  pose.covariance = turn * solved.covariance * turn.transpose();
  return pose;
}

}  // namespace

std::vector<Pose> pose_of_circle(const Camera& camera, const Sighting& sighting, double diameter_m,
                                 const Accuracy& accuracy) {
  check(camera);
  const auto* ellipse = std::get_if<Ellipse>(&sighting.outline);
  if (!ellipse) throw Error("the pose of a round marker needs an ellipse for its outline");
  if (!(diameter_m > 0)) throw Error("a marker's diameter must be above 0 m");
  const Seen seen = seen_of(camera, sighting, *ellipse);
  const Eigen::Matrix2d root = root_of_information(sighting.centre_covariance, accuracy.centre_px) *
                               Eigen::Vector2d(camera.fx, camera.fy).asDiagonal();
  std::vector<Pose> poses;
  for (const Circle& start : circles_of(conic_through(seen.outline), diameter_m / 2))
    poses.push_back(refined(camera, seen, start, diameter_m / 2, accuracy, root));
  return likeliest_first(poses);
}

}  // namespace relock::pose
