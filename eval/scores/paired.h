#pragma once

#include <array>
#include <optional>
#include <span>

#include "core/recording.h"
#include "eval/judgement/verdict.h"
#include "eval/scores/arm_sums.h"
#include "eval/statistics/interval.h"
#include "eval/trajectory.h"

namespace relock {

/// One method on one recording, with and without a drop pattern: the two arms of a paired gap experiment.
struct Pair {
  const Recording& recording;
  const Trajectory& without;  ///< as recorded
  const Trajectory& with;     ///< the pattern drops frames
};

/// One score in both arms, on their common frames. An empty value is n/a.
struct PairedScore {
  std::optional<double> without, with;
  std::optional<double> difference;  ///< with - without; of error_px the median of the frames' differences
  std::optional<Interval> interval;  ///< 95 %, of the difference; frames stay paired
};
/// What the interval of a difference says: -1 worse, 1 better, 0 nothing (it holds zero, or there is none).
int verdict_on(CostScore which, const std::optional<Interval>& difference);

/// What the gaps cost one method.
struct GapCost {
  std::size_t pairs = 0;
  std::size_t frames = 0;          ///< recorded in all pairs, as far as they were compared
  std::size_t common_frames = 0;   ///< of them, delivered in both arms
  std::size_t ended_at_reset = 0;  ///< pairs that the first reset of either arm ended
  std::size_t losses_without = 0, losses_with = 0;
  double label_sigma_px = 0;                    ///< RMS accuracy of the labels behind error_px; 0: exact
  std::array<PairedScore, kCostScores> scores;  ///< by CostScore
  /// Availability on all recorded frames as far as they were compared: gaps make fixes old, whatever the
  /// method does, and only here is that seen.
  std::optional<double> recorded_availability_without, recorded_availability_with;

  const PairedScore& operator[](CostScore score) const { return scores[static_cast<std::size_t>(score)]; }
};

/// Compares the arms of every pair on their common frames (eval/scores/common_frames.h) and pools the pairs. Pairs on
/// recordings of one name are repetitions (seeds) of one sequence: they are added up frame by frame, so that
/// many seeds do not pass for many sequences. Throws Error when a trajectory is not of its recording.
GapCost cost_of_gaps(std::span<const Pair> pairs, const Gate& gate = {});

}  // namespace relock
