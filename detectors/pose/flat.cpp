// Poses from points of a plane: corners of a square, middles of markers on a plate.

#include <ceres/ceres.h>
#include <ceres/rotation.h>

#include <algorithm>
#include <array>
#include <opencv2/calib3d.hpp>

#include "core/error.h"
#include "detectors/pose/choice.h"
#include "detectors/pose/pose.h"

namespace relock::pose {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// A point of the plane, m, and where it is seen without the lens's distortion, normalised.
struct Pair {
  Vector2d on_plane, seen;
  Eigen::Matrix2d root;  ///< of the information on where it is seen
};

struct Reprojection {
  Pair pair;

  template <class T>
  bool operator()(const T* u, T* residuals) const {
    const T point[3] = {T(pair.on_plane.x()), T(pair.on_plane.y()), T(0)};
    T turned[3];
    ceres::AngleAxisRotatePoint(u, point, turned);
    const T depth = turned[2] + u[5];
    const Eigen::Matrix<T, 2, 1> off((turned[0] + u[3]) / depth - pair.seen.x(),
                                     (turned[1] + u[4]) / depth - pair.seen.y());
    Eigen::Map<Eigen::Matrix<T, 2, 1>>(residuals, 2) = pair.root.cast<T>() * off;
    return true;
  }
};

/// Turns about the camera's axes that a small change of an angle-axis vector makes: its left Jacobian.
Eigen::Matrix3d turns_by_change(const Vector3d& axis) {
  const double angle = axis.norm();
  if (angle < 1e-9) return Eigen::Matrix3d::Identity();
  const Vector3d a = axis / angle;
  Eigen::Matrix3d cross;
  cross << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  const double s = std::sin(angle) / angle, c = (1 - std::cos(angle)) / angle;
  return s * Eigen::Matrix3d::Identity() + (1 - s) * a * a.transpose() + c * cross;
}

Pose refined(const std::vector<Pair>& pairs, std::array<double, 6> u) {
  ceres::Problem problem;
  for (const Pair& pair : pairs)
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<Reprojection, 2, 6>(new Reprojection{pair}),
                             nullptr, u.data());
  const Solved solved = solve(problem, u.data(), 6);
  const Vector3d axis(u[0], u[1], u[2]);
  Pose pose;
  pose.position = {u[3], u[4], u[5]};
  pose.rotation = axis.norm() > 0 ? Eigen::Quaterniond(Eigen::AngleAxisd(axis.norm(), axis.normalized()))
                                  : Eigen::Quaterniond::Identity();
  pose.normal = *pose.rotation * -Vector3d::UnitZ();
  pose.misfit = solved.misfit;
  Eigen::Matrix<double, 6, 6> order = Eigen::Matrix<double, 6, 6>::Zero();
  order.topRightCorner<3, 3>().setIdentity();
  order.bottomLeftCorner<3, 3>() = turns_by_change(axis);
  pose.covariance = order * solved.covariance * order.transpose();
  return pose;
}

/// From the one or two poses that IPPE finds (Collins and Bartoli 2014).
std::vector<Pose> poses_of(const std::vector<Pair>& pairs) {
  std::vector<cv::Point3d> points;
  std::vector<cv::Point2d> seen;
  for (const Pair& pair : pairs) {
    points.emplace_back(pair.on_plane.x(), pair.on_plane.y(), 0);
    seen.emplace_back(pair.seen.x(), pair.seen.y());
  }
  std::vector<cv::Mat> turns, places;
  cv::solvePnPGeneric(points, seen, cv::Matx33d::eye(), cv::noArray(), turns, places, false,
                      cv::SOLVEPNP_IPPE);
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < turns.size(); ++i) {
    const cv::Vec3d turn(turns[i]), place(places[i]);
    if (!(place[2] > 0)) continue;
    poses.push_back(refined(pairs, {turn[0], turn[1], turn[2], place[0], place[1], place[2]}));
  }
  return likeliest_first(poses);
}

Eigen::Matrix2d root_on_plane(const Camera& camera, const Eigen::Matrix2d& root_px) {
  return root_px * Vector2d(camera.fx, camera.fy).asDiagonal();
}

/// Whether points lie on a line, or nearly.
bool on_a_line(const std::vector<Pair>& pairs) {
  Vector2d mean = Vector2d::Zero();
  for (const Pair& pair : pairs) mean += pair.on_plane / static_cast<double>(pairs.size());
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  for (const Pair& pair : pairs) spread += (pair.on_plane - mean) * (pair.on_plane - mean).transpose();
  return spread.determinant() < 1e-4 * spread.trace() * spread.trace();
}

}  // namespace

std::vector<Pose> pose_of_square(const Camera& camera, const Sighting& sighting, double side_m,
                                 const Accuracy& accuracy) {
  check(camera);
  const auto* quad = std::get_if<Quad>(&sighting.outline);
  if (!quad) throw Error("the pose of a square marker needs four corners for its outline");
  if (!(side_m > 0)) throw Error("a marker's side must be above 0 m");
  const Eigen::Matrix2d root = root_on_plane(camera, root_of_information({}, accuracy.outline_px));
  const double h = side_m / 2;
  const std::array<Vector2d, 4> corners{Vector2d(-h, -h), Vector2d(h, -h), Vector2d(h, h), Vector2d(-h, h)};
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < 4; ++i)
    pairs.push_back({corners[i], normalised(camera, quad->corner[i]), root});
  return poses_of(pairs);
}

std::vector<Pose> pose_of_plate(const Camera& camera, const Sightings& sightings,
                                const std::vector<Placed>& plate, const Accuracy& accuracy) {
  check(camera);
  std::vector<Pair> pairs;
  for (const Placed& marker : plate) {
    const auto found = std::find_if(sightings.begin(), sightings.end(),
                                    [&](const Sighting& s) { return s.code == marker.code; });
    if (found == sightings.end()) continue;
    pairs.push_back(
        {marker.middle_m, normalised(camera, found->centre),
         root_on_plane(camera, root_of_information(found->centre_covariance, accuracy.centre_px))});
  }
  if (pairs.size() < 4 || on_a_line(pairs)) return {};
  return poses_of(pairs);
}

std::vector<Pose> pose_of(const Camera& camera, const Sighting& sighting, double size_m,
                          const Accuracy& accuracy) {
  if (std::holds_alternative<Ellipse>(sighting.outline))
    return pose_of_circle(camera, sighting, size_m, accuracy);
  if (std::holds_alternative<Quad>(sighting.outline))
    return pose_of_square(camera, sighting, size_m, accuracy);
  return {};
}

}  // namespace relock::pose
