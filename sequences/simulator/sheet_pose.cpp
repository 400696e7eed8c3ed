#include "sequences/simulator/sheet_pose.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "core/error.h"

namespace relock::simulator {
namespace {

using Eigen::Matrix2d, Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d;

/// The image of a circle about the middle of a sheet: its conic x^T C x = 0, taken along by the homography.
Ellipse ellipse_of_circle(double radius, const Matrix3d& homography) {
  // About the image of the middle and in units of the circle, so that the numbers are near 1.
  Matrix3d to_near = Matrix3d::Identity();
  const Vector3d middle = homography.col(2) / homography(2, 2);
  to_near.topRightCorner<2, 1>() = -middle.head<2>();
  const Matrix3d scaled = to_near * homography * Vector3d(radius, radius, 1).asDiagonal();
  const Matrix3d back = scaled.inverse();
  const Matrix3d conic = back.transpose() * Vector3d(1, 1, -1).asDiagonal() * back;
  const Matrix2d form = conic.topLeftCorner<2, 2>();
  const Vector2d centre = -form.inverse() * conic.topRightCorner<2, 1>();
  const double level = -(conic(2, 2) + conic.topRightCorner<2, 1>().dot(centre));
  const Eigen::SelfAdjointEigenSolver<Matrix2d> axes(form /
                                                     level);  // the major axis belongs to the smaller one
  if (!(axes.eigenvalues()(0) > 0)) return {};
  const Vector2d major = axes.eigenvectors().col(0);
  double angle = std::atan2(major.y(), major.x());
  if (angle < 0) angle += std::numbers::pi;
  if (angle >= std::numbers::pi) angle = 0;
  return {{middle.x() + centre.x(), middle.y() + centre.y()},
          1 / std::sqrt(axes.eigenvalues()(0)),
          1 / std::sqrt(axes.eigenvalues()(1)),
          angle};
}

Vec2 seen(const Matrix3d& homography, double x, double y) {
  const Vector3d at = homography * Vector3d(x, y, 1);
  return {at.x() / at.z(), at.y() / at.z()};
}

/// Of length 1, `distance_m` from the camera along the line of sight through the place.
SheetPose posed(const Hang& hang, double distance_m, const Camera& camera) {
  const Vector2d at = normalised(camera, hang.place);
  const Vector3d sight = Vector3d(at.x(), at.y(), 1).normalized();
  const Vector3d level = (Vector3d::UnitX() - sight.x() * sight).normalized(), upright = sight.cross(level);
  const Vector3d away = std::cos(hang.azimuth_rad) * level + std::sin(hang.azimuth_rad) * upright;
  const Eigen::AngleAxisd tilt(hang.tilt_rad, away.cross(sight));
  const double c = std::cos(hang.turn_rad), s = std::sin(hang.turn_rad);
  return {distance_m * sight, tilt * (c * level + s * upright), tilt * (c * upright - s * level)};
}

/// Whether all of a circle is before the camera.
bool in_front(const SheetPose& pose, double radius_m) {
  return pose.position.z() > radius_m * std::hypot(pose.right.z(), pose.down.z());
}

}  // namespace

Matrix3d homography(const SheetPose& pose, const Camera& camera) {
  Matrix3d lens = Matrix3d::Identity(), sheet;
  lens(0, 0) = lens(1, 1) = camera.focal_px;
  lens(0, 2) = camera.middle().x, lens(1, 2) = camera.middle().y;
  sheet << pose.right, pose.down, pose.position;
  return lens * sheet;
}

SheetPose pose_of(const Hang& hang, double size_m, const Camera& camera) {
  // Nearly in proportion to the distance, so that this settles in a few rounds.
  double distance_m = camera.focal_px * size_m / hang.size_px;
  for (int round = 0; round < 100; ++round) {
    const SheetPose pose = posed(hang, distance_m, camera);
    const double corner_m = size_m / std::numbers::sqrt2;
    if (!in_front(pose, corner_m)) break;
    const double size_px = 2 * ellipse_of_circle(size_m / 2, homography(pose, camera)).semi_major;
    if (std::abs(size_px - hang.size_px) < 1e-10 * hang.size_px) return pose;
    distance_m *= size_px / hang.size_px;
  }
  throw Error(
      fmt::format("a target of {:.0f} px tilted by {:.0f} degrees is not before the camera as a whole; "
                  "give it a smaller size or tilt, or the camera a longer focal length",
                  hang.size_px, hang.tilt_rad * 180 / std::numbers::pi));
}

Outline outline_of(const PrintedTarget& target, const SheetPose& pose, const Camera& camera) {
  const Matrix3d to_picture = homography(pose, camera);
  const double half = target.size_m / 2;
  if (target.outline == PrintedOutline::circle) return ellipse_of_circle(half, to_picture);
  return Quad{{seen(to_picture, -half, -half), seen(to_picture, half, -half), seen(to_picture, half, half),
               seen(to_picture, -half, half)}};
}

}  // namespace relock::simulator
