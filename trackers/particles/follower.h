#pragma once

#include <vector>

#include "trackers/checked_tracker.h"
#include "trackers/particles/filter.h"
#include "trackers/particles/proposal.h"
#include "trackers/particles/sampling.h"

namespace relock::particles {

/// The frame of a tracker by particles: where they go and what they see, which of them is the estimate, and which
/// of them live on. What a target looks like, and how much a look is like it, is the model's, in a derived class.
class ParticleFollower : public Follower {
 public:
  void start(const Image& picture, const Box& box) final;
  std::optional<Sighting> follow(const Image& picture) final;
  void expect(const Box& prior, double sigma_px) final { hint_ = Hint{prior, sigma_px}; }

 protected:
  ParticleFollower(const ParticleOptions& options, const ProposalOptions& proposal, std::uint64_t seed)
      : options_(options), proposal_(proposal), random_(seed) {}

  /// What is learnt from the start box, which is at `state` in the picture shown to `sampling`.
  virtual void learn_start(const Sampling& sampling, const State& state) = 0;

  /// The part of each look that the model does not explain, from 0 to 1, into `unexplained`, for those that are
  /// usable. A model may leave out particles whose weight would be too small to matter: theirs stays infinite.
  virtual void explain(const Observations& observations, std::vector<double>& unexplained) = 0;

  /// The motion that the blur of the look explained best tells, in the picture, for models that know one; it was
  /// seen at `state`.
  virtual std::optional<BlurEstimate> read_blur([[maybe_unused]] const State& state) { return std::nullopt; }

  /// Learns from the estimate, perhaps. `sharp`: no blur was read.
  virtual void learn(const Eigen::Ref<const Eigen::VectorXf>& look, bool sharp) = 0;

  const ParticleOptions& options() const { return options_; }
  Vec2 start_size() const { return start_size_; }
  Random& random() { return random_; }

 private:
  std::optional<std::size_t> weigh();
  void move_estimate(const State& to, const std::optional<BlurEstimate>& blur);
  Sighting sighting(double unexplained) const;

  ParticleOptions options_;
  ProposalOptions proposal_;
  Random random_;
  Vec2 start_size_;
  std::optional<Sampling> sampling_;
  std::vector<State> particles_;
  Motion motion_;
  std::optional<Hint> hint_;
  // Of the frame that is being looked at.
  std::vector<State> proposed_;
  Observations observations_;
  std::vector<double> unexplained_, weights_;
};

}  // namespace relock::particles
