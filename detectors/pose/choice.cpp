#include "detectors/pose/choice.h"

#include <ceres/ceres.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace relock::pose {
namespace {

/// Poses whose normals differ by less are one, radians.
constexpr double kSame_rad = 2e-3;

double between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

double Pose::normal_deviation_rad() const {
  // Turns about the normal leave it where it is.
  const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - normal * normal.transpose();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(across * covariance.bottomRightCorner<3, 3>() * across);
  return std::sqrt(std::max(solver.eigenvalues()(2), 0.0));
}

Solved solve(ceres::Problem& problem, double* unknowns, int count) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = 50;
  options.function_tolerance = 1e-12;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) throw Error("no pose explains what is seen: is the camera the right one?");
  ceres::Covariance::Options exactly;
  exactly.algorithm_type = ceres::DENSE_SVD;
  exactly.min_reciprocal_condition_number = 1e-20;
  ceres::Covariance covariance(exactly);
  const std::vector<std::pair<const double*, const double*>> all{{unknowns, unknowns}};
  Solved solved{2 * summary.final_cost, Eigen::MatrixXd::Zero(count, count)};
  if (covariance.Compute(all, &problem))
    covariance.GetCovarianceBlock(unknowns, unknowns, solved.covariance.data());
  return solved;
}

Eigen::Matrix2d root_of_information(const std::optional<Covariance>& covariance, double else_deviation_px) {
  const double variance = else_deviation_px * else_deviation_px;
  Eigen::Matrix2d matrix = variance * Eigen::Matrix2d::Identity();
  if (covariance) matrix << covariance->xx, covariance->xy, covariance->xy, covariance->yy;
  return matrix.inverse().llt().matrixU();
}

std::vector<Pose> likeliest_first(std::vector<Pose> poses) {
  std::stable_sort(poses.begin(), poses.end(),
                   [](const Pose& a, const Pose& b) { return a.misfit < b.misfit; });
  std::vector<Pose> all;
  double sum = 0;
  for (Pose& pose : poses) {
    const auto same = [&](const Pose& other) { return between(pose.normal, other.normal) < kSame_rad; };
    if (std::any_of(all.begin(), all.end(), same)) continue;
    pose.probability = std::exp(-0.5 * (pose.misfit - poses.front().misfit));
    sum += pose.probability;
    all.push_back(pose);
  }
  for (Pose& pose : all) pose.probability /= sum;
  return all;
}

}  // namespace relock::pose
