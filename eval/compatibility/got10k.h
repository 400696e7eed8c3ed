#pragma once

#include <optional>
#include <span>
#include <vector>

#include "eval/compatibility/answers.h"

namespace relock {

/// Scores of the GOT-10k toolkit 0.1.3 (ExperimentGOT10k.report).
///
/// Compared are the upright boxes around answer and truth, by `got10k_overlap`. The first frame of each sequence
/// is left out, and so are frames on which nothing of the target is visible (cover 0). The frames of all
/// sequences are pooled. An answer that is missing overlaps by 0.
struct Got10kScores {
  std::size_t frames = 0;       ///< that were compared
  std::optional<double> ao;     ///< average overlap; nothing without frames, like what follows
  std::optional<double> sr50;   ///< success rate: share of overlaps > 0.5
  std::optional<double> sr75;   ///< share of overlaps > 0.75
  std::vector<double> success;  ///< share of overlaps > 0, 0.01 … 1: 101 values; empty without frames
};
Got10kScores got10k_scores(std::span<const AnsweredSequence> sequences);

}  // namespace relock
