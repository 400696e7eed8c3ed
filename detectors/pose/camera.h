#pragma once

#include <Eigen/Core>
#include <array>

#include "core/geometry.h"

namespace relock::pose {

/// A calibrated camera, as OpenCV has it. In its coordinates x is to the right, y down, z along the view (metres). A
/// point (X, Y, Z) has the normalised place (X, Y) / Z; the lens distorts that radially (k1, k2, k3) and tangentially
/// (p1, p2), and the pixel is (fx x + cx, fy y + cy), pixel centres at integers.
struct Camera {
  Size picture;                           ///< that it was calibrated for; {0, 0}: not stated
  double fx = 0, fy = 0, cx = 0, cy = 0;  ///< px
  std::array<double, 5> distortion{};     ///< k1, k2, p1, p2, k3

  double focal_px() const { return 0.5 * (fx + fy); }
};

/// Throws Error when it is none: focal lengths that are not positive, numbers that are not finite.
void check(const Camera& camera);

/// The normalised place that is seen at a pixel.
Eigen::Vector2d normalised(const Camera& camera, Vec2 pixel);
/// The pixel at which a point in front of the camera is seen.
Vec2 project(const Camera& camera, const Eigen::Vector3d& point);

}  // namespace relock::pose
