#pragma once

#include <optional>
#include <span>

#include "core/sighting.h"
#include "trackers/particles/filter.h"

namespace relock::particles {

/// How particles move on from one frame to the next.
struct ProposalOptions {
  bool blur_lobes = true;        ///< particles go where the blur says that the target went
  bool velocity = false;         ///< particles go on at the last velocity
  double kappa = 1.2;            ///< frame period over exposure: motion in a frame over motion in the blur
  double lobe_share = 0.6;       ///< of the particles that go into the two lobes after a blurred frame
  double lobe_spread = 0.35;     ///< of a lobe along the motion, of its distance
  double velocity_share = 0.8;   ///< of the particles that go into no lobe
  double velocity_spread = 0.4;  ///< of the velocity's length
};

/// What the last frames tell of the motion.
struct Motion {
  State last = {};                        ///< the estimate
  Vec2 velocity = {};                     ///< px a frame
  std::optional<BlurEstimate> blur = {};  ///< in the picture; nothing when it was sharp
};

/// Moves every particle on, in the mixture of two lobes at a distance of kappa blur lengths before and behind the last
/// place (a blur tells no sense), a lobe at the last velocity, and a random walk from where the particle was. With a
/// hint, four fifths follow that instead. `start`: width and height of the start box, px.
void propose(const Motion& motion, const std::optional<Hint>& hint, const ParticleOptions& filter,
             const ProposalOptions& options, Vec2 start, std::span<State> particles, Random& random);

}  // namespace relock::particles
