#pragma once

#include <vector>

#include "cli/comparison.h"
#include "cli/json_text.h"

namespace relock::reports {

/// Of each comparison: when its frames were taken, which were dropped, and of each target its blur, its size and a lane
/// for each method: verdict and error of every frame, and every loss in words.
///
/// Letters of verdicts are those of `letter` (eval/judgement/verdict.h), and 'u' for an unlabelled frame on which the
/// method said where the target is.
Json timelines_json(const ScoredComparison& compared);

/// What a run said of a target on a frame; nothing where it said nothing. A detection without a track is the target's
/// by its code, else any is.
const Sighting* said_of(const FrameReport& report, const Target& target);

/// Of each frame the share of pairs of methods, yardsticks apart, that put the target at one place, within 0.5 D of one
/// another. Nothing where fewer than two said a place.
std::vector<std::optional<double>> agreement(const StoredComparison& comparison, std::size_t target);

}  // namespace relock::reports
