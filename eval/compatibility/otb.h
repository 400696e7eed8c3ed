#pragma once

#include <optional>
#include <span>
#include <vector>

#include "eval/compatibility/answers.h"

namespace relock {

/// Scores of the OTB toolkit (tracker_benchmark v1.0, one-pass evaluation: genPerfMat, calcSeqErrRobust).
///
/// Compared are the upright boxes around answer and truth. The answer in the first frame is the true box, and
/// the frame counts. Where an answer is missing the last one stands. A frame whose true box, in 1-based
/// coordinates, has a number that is not positive (it is absent, or reaches over the left or upper border)
/// has overlap -1 and centre error -1: never a success, always precise. Curves are averaged over sequences.
struct OtbScores {
  std::size_t sequences = 0;
  std::vector<double> success;    ///< share of overlaps > 0, 0.05 … 1: 21 values
  std::vector<double> precision;  ///< share of centre errors <= 0, 1 … 50 px: 51 values
  std::optional<double> auc;      ///< mean of the 21 values; nothing without sequences, like what follows
  std::optional<double> success_rate;  ///< share of overlaps > 0.5
  std::optional<double> precision_20;  ///< share of centre errors <= 20 px
};
OtbScores otb_scores(std::span<const AnsweredSequence> sequences);

}  // namespace relock
