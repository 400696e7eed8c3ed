#pragma once

#include <Eigen/Core>

namespace relock {

/// The problem of trackers/blut/sparse_solver.h as it is stated, with a trivial template +I and -I for each
/// pixel: minimise 1/2 ||y - D c - u + v||^2 + w'c + le sum(u + v) + mu/2 ||u - v||^2 over c, u, v >= 0. In
/// double.
struct ExplicitProblem {
  Eigen::MatrixXd dictionary;
  Eigen::VectorXd weights;
  double trivial_weight = 0.01, trivial_ridge = 0;

  double objective(const Eigen::VectorXd& look, const Eigen::VectorXd& c, const Eigen::VectorXd& e) const;

  /// The smallest objective within a part of 1e-4, found without anything that the solver rests on: an
  /// interior point method on all n + 2 d unknowns.
  double interior_point(const Eigen::VectorXd& look) const;

  /// No objective is lower (weak duality). Near the smallest one if `c` is near its place.
  double dual_bound(const Eigen::VectorXd& look, const Eigen::VectorXd& c) const;
};

}  // namespace relock
