#pragma once

#include <array>
#include <vector>

#include "cli/comparison.h"
#include "cli/reproduce/experiment.h"

namespace relock::reproduction {

/// Successive frames of a ring 00 about BLUT's first loss, above what the ring's detector says of the same.
std::vector<Finding> figure_13(const Settings& settings, const Methods& methods);
/// The same of the ring 01.
std::vector<Finding> figure_14(const Settings& settings, const Methods& methods);

/// Which frames a strip shows: five in a row, of which the second is the last good one before the method's first loss;
/// fewer at an end of the recording. Without a loss those about the step over which the target goes farthest.
struct StripFrames {
  std::vector<FrameIndex> frames;
  bool loss = false;
};
StripFrames strip_frames(const Recording& recording, const TargetTimeline& timeline);

}  // namespace relock::reproduction
