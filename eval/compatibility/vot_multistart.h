#pragma once

#include <optional>
#include <span>
#include <vector>

#include "eval/compatibility/answers.h"

namespace relock {

/// Of the stack vot2020 in the VOT toolkit.
struct VotMultistartOptions {
  double threshold = 0.1;      ///< overlaps up to this much are misses
  std::size_t grace = 10;      ///< misses in a row that are a failure
  std::size_t eao_low = 115;   ///< shortest run averaged over, frames
  std::size_t eao_high = 755;  ///< longest
};

/// Scores of the VOT toolkit 0.8.0 for multi-start experiments (protocol `multistart`).
///
/// A run goes from its anchor to the recording's end, or its beginning; it fails at the first of `grace` misses in
/// a row, and what comes after does not count. Frames on which the target is not there are no misses. The
/// anchor's own frame has overlap 0 and counts, as in the toolkit: a perfect method has an accuracy just below 1.
struct VotMultistartScores {
  std::size_t runs = 0;
  std::size_t failures = 0;
  std::optional<double> accuracy;        ///< mean overlap up to failures; 0 when no frame is left
  std::optional<double> robustness;      ///< share of frames up to failures; sequences weigh by their length
  std::vector<double> expected_overlap;  ///< by length from 0, up to eao_high - 1: the EAO curve
  std::optional<double> eao;             ///< its mean from eao_low on; nothing when no run lasts or failed
};

/// `runs`: one for each anchor; those of one recording have the same name.
VotMultistartScores vot_multistart_scores(std::span<const AnsweredSequence> runs,
                                          const VotMultistartOptions& options = {});

}  // namespace relock
