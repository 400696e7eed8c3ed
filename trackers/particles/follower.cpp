#include "trackers/particles/follower.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace relock::particles {

void ParticleFollower::start(const Image& picture, const Box& box) {
  start_size_ = {box.width, box.height};
  motion_.last = State{.centre = centre_of(box)};
  particles_.assign(static_cast<std::size_t>(options_.particles), motion_.last);
  sampling_.emplace(options_.grid, start_size_);
  sampling_->show(picture, motion_.last.scale);
  learn_start(*sampling_, motion_.last);
}

// Wu, Ling, Yu, Li, Mei and Cheng (2011), without the templates, which are the model's.
std::optional<Sighting> ParticleFollower::follow(const Image& picture) {
  const auto hint = std::exchange(hint_, std::nullopt);
  proposed_ = particles_;
  propose(motion_, hint, options_, proposal_, start_size_, proposed_, random_);

  sampling_->show(picture, motion_.last.scale);
  sampling_->observe(proposed_, observations_);
  explain(observations_, unexplained_);  // bound and solve, in `blut`
  const auto best = weigh();
  // A picture without contrast, or no particle near it: they stay where they were.
  if (!best) return std::nullopt;

  const State& estimate = proposed_[*best];
  const auto blur = read_blur(estimate);
  move_estimate(estimate, blur);
  particles_ = resampled(weights_, proposed_, random_);
  learn(observations_.look.col(static_cast<Eigen::Index>(*best)), !blur);

  const double unexplained = unexplained_[*best];
  if (1 - unexplained < options_.least_confidence) return std::nullopt;
  return sighting(unexplained);
}

/// The likelihood alone. Strictly, a weight is likelihood times transition over proposal; neither of the published
/// trackers does this, and it would take away from the lobes just what they give.
/// Returns the particle of the largest weight, as the published code does, and not their mean.
std::optional<std::size_t> ParticleFollower::weigh() {
  const auto best = std::min_element(unexplained_.begin(), unexplained_.end());
  if (best == unexplained_.end() || !std::isfinite(*best)) return std::nullopt;
  // Relative to the best one: all may be too small to be told from 0.
  weights_.clear();
  for (const double r : unexplained_) weights_.push_back(std::exp(-options_.alpha * (r - *best)));
  return static_cast<std::size_t>(best - unexplained_.begin());
}

void ParticleFollower::move_estimate(const State& to, const std::optional<BlurEstimate>& blur) {
  motion_ = {.last = to, .velocity = to.centre - motion_.last.centre, .blur = blur};
}

Sighting ParticleFollower::sighting(double unexplained) const {
  Sighting sighting = sighting_of(unturned_box(motion_.last, start_size_));
  sighting.confidence = std::clamp(1 - unexplained, 0.0, 1.0);
  sighting.blur = motion_.blur;
  return sighting;
}

}  // namespace relock::particles
