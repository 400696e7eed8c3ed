#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "detectors/pose/pose.h"

namespace ceres {
class Problem;
}

namespace relock::pose {

/// A problem of one block of unknowns, solved.
struct Solved {
  double misfit = 0;  ///< sum of squared residuals
  Eigen::MatrixXd covariance;
};
/// Throws Error when it comes to no end, which no well-formed sighting does.
Solved solve(ceres::Problem& problem, double* unknowns, int count);

/// Weighs what is off by some px by how sure it is: root' root is the inverse of the covariance.
Eigen::Matrix2d root_of_information(const std::optional<Covariance>& covariance, double else_deviation_px);

/// The same pose once, likeliest first, with their probabilities.
std::vector<Pose> likeliest_first(std::vector<Pose> poses);

}  // namespace relock::pose
