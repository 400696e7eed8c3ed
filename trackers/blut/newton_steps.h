#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "trackers/blut/robust_loss.h"

namespace relock::blut {

/// Minimises F(c) of sparse_solver.h over the coefficients of a few chosen templates, the others being 0.
///
/// F is piecewise quadratic, so Newton's method ends at the minimum after a finite number of steps, once it
/// is known which pixels are beyond the knee and which coefficients are 0. A step is (1) the quadratic that
/// agrees with F here, (2) its minimum under c >= 0, by an active set: coefficients that would become
/// negative stop at 0 and leave, one after the other, and (3) as far towards it as F falls.
class NewtonSteps {
 public:
  NewtonSteps(Eigen::Index pixels, Eigen::Index templates, const RobustLoss& loss);

  /// At most `most` steps; fewer when the KKT residual of the chosen ones falls to `tolerance`. `chosen`:
  /// columns of `dictionary` that may be used, all with c > 0 among them. `residual`: y - D c, and is kept
  /// so.
  void run(const Eigen::MatrixXf& dictionary, const Eigen::VectorXf& weights,
           const std::vector<Eigen::Index>& chosen, int most, float tolerance, Eigen::ArrayXf& residual,
           Eigen::VectorXf& coefficients);

 private:
  float find_gradient(const Eigen::ArrayXf& residual);
  void find_hessian(const Eigen::ArrayXf& residual);
  void find_target();
  void find_free_minimum();
  bool solve_damped(float damping);
  bool move(Eigen::ArrayXf& residual);
  float slope_at(float t, const Eigen::ArrayXf& residual) const;
  float best_step(float slope_at_0, const Eigen::ArrayXf& residual) const;

  RobustLoss loss_;
  Eigen::Index count_ = 0;  // of chosen templates; the first so many columns and elements below are in use
  Eigen::MatrixXf templates_;
  Eigen::VectorXf bent_;  // a template, every pixel times the curvature of its loss
  Eigen::VectorXf weights_, coefficients_, gradient_, target_, change_;
  Eigen::MatrixXf hessian_, factor_;
  Eigen::VectorXf solution_, free_minimum_;
  std::vector<Eigen::Index> free_;  // may change in this step
  Eigen::ArrayXf slopes_, curvature_, direction_;
  float weight_slope_ = 0;
};

/// The largest violation of the conditions of a minimum under c >= 0.
inline float kkt_residual(float coefficient, float gradient) {
  return coefficient > 0 ? std::abs(gradient) : std::max(0.F, -gradient);
}

}  // namespace relock::blut
