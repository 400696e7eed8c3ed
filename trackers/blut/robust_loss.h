#pragma once

#include <Eigen/Core>

namespace relock::blut {

/// phi of sparse_solver.h, of many residuals: with rho = mu/(1 + mu) it is rho r^2/2 + (1 - rho) h(r), where
/// h is Huber's loss with knee le: h(r) = k (r - k/2), k = r clipped to -le … le.
struct RobustLoss {
  float knee = 0;  ///< le
  float rho = 0;

  template <class Residuals>
  float value(const Eigen::ArrayBase<Residuals>& r) const {
    const auto clipped = r.max(-knee).min(knee);
    return (rho / 2 * r.square() + (1 - rho) * clipped * (r - clipped / 2)).sum();
  }

  /// The first derivative, r - e(r). An expression: `r` must outlive it.
  template <class Residuals>
  auto slope(const Eigen::ArrayBase<Residuals>& r) const {
    return rho * r.derived() + (1 - rho) * r.derived().max(-knee).min(knee);
  }

  /// The second derivative: 1 up to the knee, rho beyond.
  void curvature(const Eigen::ArrayXf& r, Eigen::ArrayXf& curvature) const {
    curvature = (r.abs() <= knee).select(Eigen::ArrayXf::Ones(r.size()), rho);
  }
};

}  // namespace relock::blut
