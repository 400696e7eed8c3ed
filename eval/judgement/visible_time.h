#pragma once

#include <span>
#include <vector>

#include "eval/judgement/states.h"

namespace relock {

/// A stretch of visible time, from one labelled frame to the next (metrics.md section 6).
struct VisibleInterval {
  std::size_t frame = 0;  ///< the labelled frame it begins at
  Time from, to;
};

/// Visible time of a target: an interval between consecutive labelled frames counts when both are visible and
/// it is at most 0.5 s or holds no unlabelled frame; never over a pause, and not when it begins at a frame
/// that is NotStarted or Given. In order, without overlap.
std::vector<VisibleInterval> visible_time(const Recording& recording, std::size_t target,
                                          std::span<const Judgement> judgements);

/// Of each visible interval, how long the newest of the `fixes` (rising capture times) is at most kFreshFix old.
std::vector<Duration> fresh_times(std::span<const VisibleInterval> visible, std::span<const Time> fixes);

/// Whether a frame enters recognition: visible, and not NotStarted, Given or Dropped. A perfect method Hits
/// it.
bool could_hit(const TargetTruth& truth, Verdict verdict);

/// The states of a perfect method on the same frames, given the same boxes.
std::vector<State> perfect_states(const Recording& recording, std::size_t target,
                                  std::span<const Judgement> judgements);

}  // namespace relock
