#pragma once

#include <Eigen/Core>

#include "core/printed_target.h"
#include "sequences/simulator/camera.h"

namespace relock::simulator {

/// How a sheet hangs before a camera, in the camera's coordinates (camera.h).
struct SheetPose {
  Eigen::Vector3d position = Eigen::Vector3d::UnitZ();  ///< of the sheet's middle, m
  Eigen::Vector3d right = Eigen::Vector3d::UnitX();     ///< along its top edge, length 1
  Eigen::Vector3d down = Eigen::Vector3d::UnitY();      ///< along its left edge, length 1

  Eigen::Vector3d normal() const { return right.cross(down); }  ///< away from who sees it, length 1
};

/// A pose by what is seen of it.
struct Hang {
  Vec2 place;  ///< where the sheet's middle is seen, px
  double size_px =
      150;  ///< major axis of the image of the outline, if round; of its inscribed circle, if square
  double tilt_rad = 0;     ///< between the normal and the line of sight, below a quarter turn
  double azimuth_rad = 0;  ///< direction, from +x towards +y, of the side that is farther away
  double turn_rad = 0;     ///< of the sheet in its own plane, from +x towards +y
};

/// The pose of a target of `size_m` that is seen so. The camera has no distortion. Throws Error when part of the
/// target would be behind the camera: it is too large and too tilted.
SheetPose pose_of(const Hang& hang, double size_m, const Camera& camera);

/// From places on the sheet (m right and down of its middle, and 1) to homogeneous pixels.
Eigen::Matrix3d homography(const SheetPose& pose, const Camera& camera);

/// The exact image of the target's outline: Ellipse or Quad.
Outline outline_of(const PrintedTarget& target, const SheetPose& pose, const Camera& camera);

}  // namespace relock::simulator
