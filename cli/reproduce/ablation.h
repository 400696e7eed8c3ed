#pragma once

#include <vector>

#include "cli/reproduce/experiment.h"
#include "cli/reproduce/gap_counts.h"

namespace relock::reproduction {

/// What each idea in BLUT is worth: without one of them at a time, and beside the trackers that it extends, on the flights
/// of `gaps_or_blur`. Left out of QUICK.
std::vector<Finding> ablation(const Settings& settings, const Methods& methods);

/// The finding, from counts of protocol reset on the arms all_frames and gaps.
Finding finding_of_ablation(const std::vector<GapCount>& counts);

}  // namespace relock::reproduction
