#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "eval/compatibility/answers.h"

namespace relock {

/// Of the stacks vot2013 to vot2019 in the VOT toolkit.
struct VotOptions {
  std::size_t burn_in = 10;    ///< frames from a start on, itself included, that do not count for accuracy
  std::size_t skip = 5;        ///< frames from a failure to the next start
  double sensitivity = 30;     ///< frames over which robustness is the chance of no failure
  std::size_t eao_low = 100;   ///< shortest fragment averaged over: vot2015 and 2016 108, 2017 and 2018 100,
  std::size_t eao_high = 356;  ///< 2019 46; longest: 371, 356, 291
};

/// What VOT's result files say of a frame.
enum class VotCode : std::uint8_t {
  nothing,  ///< "0": between a failure and the next start, and where nothing can be judged, and where nothing can be judged
  start,    ///< "1"
  failure,  ///< "2"
  region,   ///< a region
};

/// Scores of the VOT toolkit 0.8.0 for supervised experiments (protocol `vot`).
///
/// Compared are regions by `vot_overlap`: answers as they are (box or quad; of an ellipse the box around it),
/// truth likewise. A sequence counts by its length.
struct VotScores {
  std::size_t frames = 0;
  std::size_t failures = 0;              ///< of all sequences
  std::optional<double> accuracy;        ///< mean overlap behind the burn-in; 0 when no frame is left
  std::optional<double> failures_mean;   ///< failures a sequence, weighed by length: the toolkit's "R"
  std::optional<double> robustness;      ///< exp(-sensitivity * failures_mean / mean length)
  std::vector<double> expected_overlap;  ///< by fragment length from 0: the EAO curve
  std::optional<double> eao;             ///< its mean from eao_low to eao_high; nothing when it ends before
};

/// The codes of a run: a start where the box was given; a failure on the first frame after it whose overlap is
/// 0 (nothing said is no overlap), then nothing up to the next start. A start that no such frame led to means
/// that whoever ran the method saw a failure `skip` frames before. Dropped frames, and those on which the target is not
/// visible, are nothing and no failure; VOT's sequences have none, and its toolkit leaves such codes out of accuracy and
/// counts them as overlap 0 in the expected overlap.
std::vector<VotCode> vot_codes(const AnsweredSequence& sequence, const VotOptions& options = {});

VotScores vot_scores(std::span<const AnsweredSequence> sequences, const VotOptions& options = {});

}  // namespace relock
