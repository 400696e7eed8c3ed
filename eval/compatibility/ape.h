#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "eval/compatibility/answers.h"

namespace relock {

/// How the answers' path is laid over the truth's before they are compared (Umeyama 1991), as by evo's
/// --align and --align --correct_scale. Alignment hides an offset: for a tracker, none is meant.
enum class Alignment : std::uint8_t { none, rigid, similarity };
/// "none", "rigid" or "similarity". Throws Error otherwise.
Alignment parse_alignment(std::string_view text);

/// Absolute pose error of evo (evo_ape, translation part): distances of the outlines' centres, px, with z = 0,
/// on the frames on which the target's place is known and the method answered (given frames are no answers).
/// What it did not answer is left out: a method that gives up early fares well.
struct ApeScores {
  std::size_t frames = 0;
  std::optional<double> rmse_px;  ///< nothing without frames, like what follows
  std::optional<double> mean_px;
  std::optional<double> median_px;
  std::optional<double> std_px;
  std::optional<double> max_px;
};
/// Throws Error when fewer than three different places are to be aligned.
ApeScores ape_scores(std::span<const AnsweredSequence> sequences, Alignment alignment = Alignment::none);

}  // namespace relock
