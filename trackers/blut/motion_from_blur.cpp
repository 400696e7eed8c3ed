#include "trackers/blut/motion_from_blur.h"

#include <cmath>
#include <numbers>

namespace relock::blut {
namespace {

/// In [0, pi).
double axial(double angle) {
  const double turned = std::fmod(angle, std::numbers::pi);
  const double positive = turned < 0 ? turned + std::numbers::pi : turned;
  return positive < std::numbers::pi ? positive : 0;
}

}  // namespace

std::optional<BlurEstimate> motion_from_blur(const BlurFan& fan, double width_px,
                                             const Eigen::Ref<const Eigen::VectorXf>& coefficients,
                                             double sharp, const BlurReading& reading) {
  const double blurred = coefficients.sum();
  if (!(blurred > reading.blurred_share * (sharp + blurred))) return std::nullopt;

  Eigen::VectorXf of_direction(fan.directions);
  for (int i = 0; i < fan.directions; ++i)
    of_direction[i] = coefficients.segment(i * fan.lengths, fan.lengths).sum();
  Eigen::Index strongest = 0;
  of_direction.maxCoeff(&strongest);

  // With one or two directions the neighbours on both sides would be the same.
  const int beside = fan.directions >= 3 ? 1 : 0;
  double cosine = 0, sine = 0, lengths = 0, squares = 0, weight = 0;
  for (int neighbour = -beside; neighbour <= beside; ++neighbour) {
    const int i = (static_cast<int>(strongest) + neighbour + fan.directions) % fan.directions;
    for (int number = i * fan.lengths; number < (i + 1) * fan.lengths; ++number) {
      const BlurEstimate motion = fan.motion(number, width_px);
      const double share = coefficients[number];
      cosine += share * std::cos(2 * motion.direction_rad);
      sine += share * std::sin(2 * motion.direction_rad);
      lengths += share * motion.length_px;
      squares += share * motion.length_px * motion.length_px;
      weight += share;
    }
  }
  const bool mean = reading.length == BlurReading::Length::mean;
  const double length = mean ? lengths / weight : std::sqrt(squares / (weight + sharp));
  if (!(length >= reading.least_blur * width_px)) return std::nullopt;
  return BlurEstimate{.direction_rad = axial(0.5 * std::atan2(sine, cosine)), .length_px = length};
}

BlurEstimate seen_at(const particles::State& state, const BlurEstimate& motion) {
  const Vec2 seen =
      carried(state, motion.length_px * Vec2{std::cos(motion.direction_rad), std::sin(motion.direction_rad)});
  return {.direction_rad = axial(std::atan2(seen.y, seen.x)), .length_px = norm(seen)};
}

}  // namespace relock::blut
