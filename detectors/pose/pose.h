#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "core/sighting.h"
#include "detectors/pose/camera.h"

// Where markers of known size are, from where a camera sees them. Coordinates are the camera's (detectors/pose/camera.h).

namespace relock::pose {

/// A pose that explains what is seen.
struct Pose {
  Eigen::Vector3d position = Eigen::Vector3d::UnitZ();  ///< of the target's middle, m
  Eigen::Vector3d normal = -Eigen::Vector3d::UnitZ();   ///< of its front, towards the camera, length 1
  /// From the target's coordinates (x right, y down, z into it) to the camera's. Nothing for a ring by itself, whose turn
  /// about its own middle is not to be seen.
  std::optional<Eigen::Quaterniond> rotation = {};
  /// Of position (m) and then of small turns about the camera's axes (radians). Of a ring, those about its normal are left
  /// out: the matrix is singular along it.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  double misfit = 0;       ///< sum of squared residuals, in standard deviations
  double probability = 1;  ///< among the poses that explain the same, by their misfits

  /// Standard deviation of the normal's direction, in the direction in which it is least known, radians.
  double normal_deviation_rad() const;
};

/// How exact a sighting's outline and centre are taken to be, px, standard deviation. Where a sighting says that itself
/// of its centre, that is taken.
struct Accuracy {
  double outline_px = 0.1, centre_px = 0.1;
};

/// Of a round marker whose outermost diameter is `diameter_m`: from the image of its outline (an Ellipse) and, where it
/// is `projected`, of its middle. A circle by itself may be tilted either way (both poses are exact); the image of its
/// middle tells which, where perspective is strong enough. Likeliest first, one or two. Throws Error on an outline that is
/// no ellipse and on a diameter that is not positive.
std::vector<Pose> pose_of_circle(const Camera& camera, const Sighting& sighting, double diameter_m,
                                 const Accuracy& accuracy = {});

/// Of a square whose side is `side_m`, from its four corners (a Quad). Seen small or from afar, two tilts explain nearly
/// the same. Likeliest first. Throws Error likewise.
std::vector<Pose> pose_of_square(const Camera& camera, const Sighting& sighting, double side_m,
                                 const Accuracy& accuracy = {});

/// A marker's place on a flat plate, m, x right and y down as the plate is seen from its front.
struct Placed {
  Code code;
  Eigen::Vector2d middle_m = Eigen::Vector2d::Zero();
};
/// Of a plate with several markers, from the middles of those that were sighted: at least four that do not lie on a line.
/// The position is that of the plate's origin. Likeliest first; none where too few were sighted.
std::vector<Pose> pose_of_plate(const Camera& camera, const Sightings& sightings,
                                const std::vector<Placed>& plate, const Accuracy& accuracy = {});

/// By the sighting's outline: a circle or a square of size `size_m`; none for an upright box.
std::vector<Pose> pose_of(const Camera& camera, const Sighting& sighting, double size_m,
                          const Accuracy& accuracy = {});

}  // namespace relock::pose
