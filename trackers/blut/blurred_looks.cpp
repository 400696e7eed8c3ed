#include "trackers/blut/blurred_looks.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace relock::blut {
namespace {

constexpr int kStepsASide = 32;  // of the longest line, from its middle

/// The integral of the picture along the line through every sample, from -reach to reach, as far as each of the
/// steps: column k is over k steps to both sides, in units of a step. The trapezoid rule.
Eigen::MatrixXf integrals_along(const particles::Sampling& sampling, const particles::State& state, Vec2 step,
                                Eigen::MatrixXf& pairs) {
  Eigen::VectorXf there(sampling.grid().size()), back(sampling.grid().size());
  Eigen::MatrixXf integrals = Eigen::MatrixXf::Zero(there.size(), kStepsASide + 1);
  for (int k = 0; k <= kStepsASide; ++k) {
    particles::State moved = state;
    moved.centre = state.centre + static_cast<double>(k) * step;
    sampling.read(moved, there);
    moved.centre = state.centre - static_cast<double>(k) * step;
    sampling.read(moved, back);
    pairs.col(k) = there + back;
    if (k > 0) integrals.col(k) = integrals.col(k - 1) + 0.5F * (pairs.col(k - 1) + pairs.col(k));
  }
  return integrals;
}

}  // namespace

BlurEstimate BlurFan::motion(int number, double width_px) const {
  const int direction = number / lengths, length = number % lengths;
  const double share = lengths == 1 ? longest : shortest + (longest - shortest) * length / (lengths - 1);
  return {.direction_rad = std::numbers::pi * direction / directions, .length_px = share * width_px};
}

Eigen::MatrixXf blurred_looks(const particles::Sampling& sampling, const particles::State& state,
                              const BlurFan& fan, double width_px) {
  Eigen::MatrixXf looks(sampling.grid().size(), fan.size());
  Eigen::MatrixXf pairs(sampling.grid().size(), kStepsASide + 1);
  const double step_px = fan.longest * width_px / (2 * kStepsASide);
  for (int direction = 0; direction < fan.directions; ++direction) {
    const double angle = fan.motion(direction * fan.lengths, width_px).direction_rad;
    const Vec2 step = step_px * Vec2{std::cos(angle), std::sin(angle)};
    const Eigen::MatrixXf integrals = integrals_along(sampling, state, step, pairs);
    for (int length = 0; length < fan.lengths; ++length) {
      const int number = direction * fan.lengths + length;
      const double steps = fan.motion(number, width_px).length_px / 2 / step_px;
      const int whole = std::min(static_cast<int>(steps), kStepsASide - 1);
      const auto rest = static_cast<float>(steps - whole);
      // Between two steps the picture is taken to be straight.
      looks.col(number) = integrals.col(whole) +
                          rest * (pairs.col(whole) + 0.5F * rest * (pairs.col(whole + 1) - pairs.col(whole)));
      particles::whiten(looks.col(number));
    }
  }
  return looks;
}

}  // namespace relock::blut
