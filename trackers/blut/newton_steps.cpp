#include "trackers/blut/newton_steps.h"

#include <Eigen/Cholesky>
#include <algorithm>

namespace relock::blut {
namespace {

/// Added to the Hessian's diagonal (columns have length 1): templates that are the same, or fewer pixels up
/// to the knee than templates, would make it singular. It slows the last steps down a little and does not
/// move the minimum.
constexpr float kDamping = 1e-5F, kMostDamping = 1;

/// A step is long enough when F's slope along it has fallen to this part.
constexpr float kSlopeLeft = 0.1F;

}  // namespace

NewtonSteps::NewtonSteps(Eigen::Index pixels, Eigen::Index templates, const RobustLoss& loss)
    : loss_(loss),
      templates_(pixels, templates),
      bent_(pixels),
      weights_(templates),
      coefficients_(templates),
      gradient_(templates),
      target_(templates),
      change_(templates),
      hessian_(templates, templates),
      factor_(templates, templates),
      solution_(templates),
      free_minimum_(templates),
      slopes_(pixels),
      curvature_(pixels),
      direction_(pixels) {
  free_.reserve(static_cast<std::size_t>(templates));
}

void NewtonSteps::run(const Eigen::MatrixXf& dictionary, const Eigen::VectorXf& weights,
                      const std::vector<Eigen::Index>& chosen, int most, float tolerance,
                      Eigen::ArrayXf& residual, Eigen::VectorXf& coefficients) {
  count_ = 0;
  for (const Eigen::Index column : chosen) {
    templates_.col(count_) = dictionary.col(column);
    weights_(count_) = weights(column);
    coefficients_(count_++) = coefficients(column);
  }
  for (int step = 0; step < most && find_gradient(residual) > tolerance; ++step) {
    find_hessian(residual);
    find_target();
    if (!move(residual)) break;
  }
  Eigen::Index i = 0;
  for (const Eigen::Index column : chosen) coefficients(column) = coefficients_(i++);
}

/// Returns the largest violation.
float NewtonSteps::find_gradient(const Eigen::ArrayXf& residual) {
  slopes_ = loss_.slope(residual);
  gradient_.head(count_) = weights_.head(count_);
  gradient_.head(count_).noalias() -= templates_.leftCols(count_).transpose() * slopes_.matrix();
  float worst = 0;
  for (Eigen::Index i = 0; i < count_; ++i)
    worst = std::max(worst, kkt_residual(coefficients_(i), gradient_(i)));
  return worst;
}

/// Of the coefficients that are free to change: those above 0, and those at 0 that would grow.
void NewtonSteps::find_hessian(const Eigen::ArrayXf& residual) {
  loss_.curvature(residual, curvature_);
  free_.clear();
  for (Eigen::Index i = 0; i < count_; ++i) {
    if (coefficients_(i) <= 0 && gradient_(i) >= 0) continue;
    free_.push_back(i);
    bent_.array() = templates_.col(i).array() * curvature_;
    hessian_.col(i).head(count_).noalias() = templates_.leftCols(count_).transpose() * bent_;
  }
}

/// Minimum of the quadratic under c >= 0, free_ holding in the end those that are not stopped at 0.
void NewtonSteps::find_target() {
  target_.head(count_) = coefficients_.head(count_);
  while (!free_.empty()) {
    find_free_minimum();
    float share = 1;  // of the way to that minimum, until one would be negative
    Eigen::Index blocking = -1;
    for (const Eigen::Index i : free_) {
      if (free_minimum_(i) > 0) continue;
      const float possible = target_(i) > 0 ? target_(i) / (target_(i) - free_minimum_(i)) : 0;
      if (blocking >= 0 && possible >= share) continue;
      share = possible;
      blocking = i;
    }
    for (const Eigen::Index i : free_) target_(i) += share * (free_minimum_(i) - target_(i));
    if (blocking < 0) return;
    target_(blocking) = 0;
    std::erase(free_, blocking);
  }
}

/// Of the quadratic over the free coefficients, negative or not, the others being at their targets.
void NewtonSteps::find_free_minimum() {
  change_.head(count_) = target_.head(count_) - coefficients_.head(count_);
  for (const Eigen::Index i : free_) change_(i) = 0;
  Eigen::Index k = 0;
  for (const Eigen::Index i : free_) {
    float slope = gradient_(i);
    for (Eigen::Index other = 0; other < count_; ++other)
      if (change_(other) != 0) slope += hessian_(other, i) * change_(other);
    solution_(k++) = -slope;
  }
  for (float damping = kDamping; !solve_damped(damping); damping *= 10)
    if (damping >= kMostDamping) {
      solution_.head(k).setZero();
      break;
    }
  k = 0;
  for (const Eigen::Index i : free_) free_minimum_(i) = coefficients_(i) + solution_(k++);
}

/// (Hessian of the free ones + damping) x = solution_, x taking its place. False when the matrix is not
/// positive.
bool NewtonSteps::solve_damped(float damping) {
  Eigen::Index count = 0;
  for (const Eigen::Index i : free_) {
    Eigen::Index column = 0;
    for (const Eigen::Index k : free_) {
      factor_(count, column++) = hessian_(i, k);
      if (k == i) break;  // the upper triangle is not read
    }
    factor_(count, count) += damping;
    ++count;
  }
  Eigen::Ref<Eigen::MatrixXf> matrix = factor_.topLeftCorner(count, count);
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXf>> factor(matrix);  // in its place
  if (factor.info() != Eigen::Success) return false;
  auto solution = solution_.head(count);
  factor.solveInPlace(solution);
  return true;
}

/// False when F does not fall towards the target by what numbers of this size can tell.
bool NewtonSteps::move(Eigen::ArrayXf& residual) {
  change_.head(count_) = target_.head(count_) - coefficients_.head(count_);
  const float slope = gradient_.head(count_).dot(change_.head(count_));
  if (!(slope < 0)) return false;
  direction_.matrix().noalias() = templates_.leftCols(count_) * change_.head(count_);
  weight_slope_ = weights_.head(count_).dot(change_.head(count_));
  const float step = best_step(slope, residual);
  residual -= step * direction_;
  if (step == 1)
    coefficients_.head(count_) = target_.head(count_);
  else
    coefficients_.head(count_) = (coefficients_.head(count_) + step * change_.head(count_)).cwiseMax(0);
  return true;
}

/// Of F, the part `t` of the way to the target.
float NewtonSteps::slope_at(float t, const Eigen::ArrayXf& residual) const {
  return weight_slope_ - (loss_.slope(residual - t * direction_) * direction_).sum();
}

/// Where F has fallen enough on the way: its slope grows along it, so that a false position with bounds finds
/// a place.
float NewtonSteps::best_step(float slope_at_0, const Eigen::ArrayXf& residual) const {
  constexpr int kMost = 20;
  const float enough = -kSlopeLeft * slope_at_0;
  float low = 0, slope_low = slope_at_0, high = 1, slope_high = slope_at(1, residual), step = 1;
  if (slope_high <= enough) return 1;
  for (int i = 0; i < kMost; ++i) {
    const float margin = 0.05F * (high - low);
    step = std::clamp(low - slope_low * (high - low) / (slope_high - slope_low), low + margin, high - margin);
    const float slope = slope_at(step, residual);
    if (std::abs(slope) <= enough) break;
    (slope < 0 ? low : high) = step;
    (slope < 0 ? slope_low : slope_high) = slope;
  }
  return step;
}

}  // namespace relock::blut
