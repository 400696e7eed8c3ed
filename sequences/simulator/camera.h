#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>

#include "core/geometry.h"

namespace relock::simulator {

/// A pinhole camera with radial distortion. In its own coordinates x is to the right, y down, z along the view
/// (metres); the principal point is the middle of the picture. A point (X, Y, Z) has the normalised place
/// (x, y) = (X, Y) / Z and, with r^2 = x^2 + y^2, is seen at middle + focal_px (1 + k1 r^2 + k2 r^4) (x, y).
struct Camera {
  Size picture{640, 360};
  double focal_px = 354.5;
  double k1 = 0, k2 = 0;

  Vec2 middle() const { return {(picture.width - 1) / 2.0, (picture.height - 1) / 2.0}; }
};

/// Focal length at which the diagonal of the picture spans `diagonal_deg`, without distortion, px.
double focal_of_diagonal(Size picture, double diagonal_deg);

/// Throws Error on sizes, focal lengths or a distortion that no lens has: one that folds the picture over.
void check_camera(const Camera& camera);

/// Where a point in camera coordinates is seen, px, in the picture or beside it. Nothing when it is behind the
/// camera or farther out than the distortion is one to one.
std::optional<Vec2> project(const Camera& camera, const Eigen::Vector3d& point);

/// The normalised place (x, y) that is seen at a pixel: the inverse of `project`.
Eigen::Vector2d normalised(const Camera& camera, Vec2 pixel);

/// The camera as a calibration file of OpenCV's (YAML): what a recording has as camera.yaml.
std::string calibration_text(const Camera& camera);

/// Where the camera is and how it looks, in the world (scene.h).
struct Pose {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  ///< from camera to world coordinates
  Eigen::Vector3d position = Eigen::Vector3d::Zero();            ///< m

  Eigen::Vector3d to_camera(const Eigen::Vector3d& world) const {
    return rotation.conjugate() * (world - position);
  }
};

/// Between two poses that are close, `share` of the way from a to b.
Pose between(const Pose& a, const Pose& b, double share);

}  // namespace relock::simulator
