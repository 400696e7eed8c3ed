#pragma once

#include <memory>
#include <vector>

#include "core/options.h"
#include "core/tracker.h"
#include "trackers/particles/filter.h"

namespace relock {

struct IvtOptions {
  particles::ParticleOptions particles = {};
  int components = 16;       ///< directions in which looks may vary
  double forgetting = 0.95;  ///< what was learnt counts that much less with each batch
  int batch = 5;             ///< estimates learnt at a time
};
std::vector<OptionInfo> ivt_option_list();
/// Throws Error naming the option, the value and the legal range.
IvtOptions ivt_options(const Options& given);

/// The incremental visual tracker (IVT): Ross, Lim, Lin and Yang, "Incremental learning for robust visual tracking",
/// IJCV 77 (2008).
///
/// A target's looks are a mean and the directions in which they vary most; a particle is as good as its look is near
/// to that subspace, and every five estimates the subspace learns them, good or not. The particle filter and the
/// sampling are those of `blut` and `l1` (trackers/particles/), so that a look has mean 0 and length 1, where the
/// published code takes grey values.
///
/// It says a box in every frame but those without contrast (or below `least_confidence`). Confidence is one less the
/// squared distance from the subspace, not below 0. `expect` is honoured, as in `blut`.
std::unique_ptr<Tracker> ivt_tracker(const IvtOptions& options, std::uint64_t seed);

}  // namespace relock
