#include "trackers/particles/proposal.h"

#include <cmath>

namespace relock::particles {
namespace {

/// A step of the random walk from a place at the end of the last blur, on either side.
State in_a_lobe(const State& particle, const Motion& motion, const ParticleOptions& filter,
                const ProposalOptions& options, double width_px, Random& random) {
  const double distance = options.kappa * motion.blur->length_px;
  const double side = random.chance(0.5) ? 1 : -1;
  const double along = side * distance + options.lobe_spread * distance * random.normal();
  const double angle = motion.blur->direction_rad;
  State from = particle;
  from.centre = motion.last.centre + along * Vec2{std::cos(angle), std::sin(angle)};
  return walked(from, filter, width_px, random);
}

State at_last_velocity(const State& particle, const Motion& motion, const ParticleOptions& filter,
                       const ProposalOptions& options, double width_px, Random& random) {
  State from = particle;
  const double steps_x = 1 + options.velocity_spread * random.normal();
  const double steps_y = 1 + options.velocity_spread * random.normal();
  from.centre = motion.last.centre + Vec2{steps_x * motion.velocity.x, steps_y * motion.velocity.y};
  return walked(from, filter, width_px, random);
}

}  // namespace

void propose(const Motion& motion, const std::optional<Hint>& hint, const ParticleOptions& filter,
             const ProposalOptions& options, Vec2 start, std::span<State> particles, Random& random) {
  const double width_px = start.x * motion.last.scale;
  const double lobe_share = options.blur_lobes && motion.blur ? options.lobe_share : 0;
  const double velocity_share = options.velocity ? options.velocity_share : 0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    State& particle = particles[i];
    if (hint && trusts_hint(i)) {
      particle = hinted(particle, *hint, filter, start, random);
    } else if (random.chance(lobe_share)) {
      particle = in_a_lobe(particle, motion, filter, options, width_px, random);
    } else if (random.chance(velocity_share)) {
      particle = at_last_velocity(particle, motion, filter, options, width_px, random);
    } else {
      particle = walked(particle, filter, width_px, random);
    }
  }
}

}  // namespace relock::particles
