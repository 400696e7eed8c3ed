#pragma once

#include <string>
#include <vector>

#include "cli/reproduce/experiment.h"
#include "cli/reproduce/gap_counts.h"

namespace relock::reproduction {

/// Section 4.2.1: is it the gaps that the blur-driven tracker loses the marker at, and if so, the time or the jump?
std::vector<Finding> gaps_or_blur(const Settings& settings, const Methods& methods);

/// What was counted: started again after every loss, on all arms; and started once, on those whose frames are missing.
struct GapCounts {
  std::vector<GapCount> reset, once;
  Duration period{};
};
/// The finding from that.
Finding finding_of_gaps(const GapCounts& counts);

}  // namespace relock::reproduction
