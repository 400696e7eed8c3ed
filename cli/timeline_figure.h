#pragma once

#include <optional>
#include <vector>

#include "cli/comparison.h"
#include "cli/plot/plot.h"

namespace relock {

/// Widths that journals print figures in: one column and two, mm.
constexpr double kOneColumn_mm = 85, kTwoColumns_mm = 174;

/// How frames of a verdict look in a lane; nothing where a lane is empty.
std::optional<LaneLook> look_of(Verdict verdict);

/// The verdicts on `runs` as lanes, in seconds from the first frame: over them the gaps, and the true blur of the
/// targets where the recording knows it (of several the largest). Runs stand under one another, for each of `targets`
/// (their places in the recording) again; a run is left out for a target that it was not asked about. A frame is as
/// long as one slot, so that gaps are seen as breaks. Kinds that do not occur are not in the legend. No title: that is
/// the caption's.
LanePlot timeline_figure(const ScoredComparison& compared, const std::vector<std::size_t>& runs,
                         const std::vector<std::size_t>& targets);

}  // namespace relock
