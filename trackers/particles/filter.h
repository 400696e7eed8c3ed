#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/options.h"
#include "core/random.h"
#include "trackers/particles/sampling.h"
#include "trackers/particles/state.h"

namespace relock::particles {

/// What `blut`, `l1` and `ivt` have in common, so that what each of them adds can be told.
struct ParticleOptions {
  int particles = 400;
  Grid grid = {};
  double position_sigma = 0.12;   ///< of the random walk, per frame, of the target's width
  double scale_sigma = 0.015;     ///< of the logarithm of the scale
  double rotation_sigma = 0.005;  ///< rad
  double aspect_sigma = 0.004;    ///< of the logarithm of the aspect
  double alpha = 50;  ///< likelihood exp(-alpha r), r: part of a look's energy that is not explained
  double least_confidence = 0;  ///< below it the target is called lost
};
std::vector<OptionInfo> particle_option_list();
/// Throws Error naming the option, the value and the legal range.
ParticleOptions particle_options(const Options& given);

/// A hint where the target is in the next frame (Tracker::expect).
struct Hint {
  Box prior;
  double sigma_px = 0;
};

/// One step of the random walk: everything, the target's width being `width_px`.
State walked(const State& from, const ParticleOptions& options, double width_px, Random& random);
/// Scale, aspect and rotation alone.
State changed(const State& from, const ParticleOptions& options, Random& random);

/// Where a particle goes that trusts the hint: spread about the prior's centre by the hint's sigma and the random
/// walk's. `start`: width and height of the start box, px.
State hinted(const State& from, const Hint& hint, const ParticleOptions& options, Vec2 start, Random& random);
/// Every fifth particle does not trust it, in case it is wrong.
inline bool trusts_hint(std::size_t particle) { return particle % 5 != 0; }

/// As many particles drawn anew, in proportion to their weights (not negative, some of them positive): systematic
/// resampling, one random number for all.
std::vector<State> resampled(std::span<const double> weights, std::span<const State> particles,
                             Random& random);

}  // namespace relock::particles
