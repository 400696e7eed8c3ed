#pragma once

#include <optional>
#include <span>
#include <vector>

#include "eval/statistics/interval.h"

namespace relock {

/// Of one sequence, what each frame adds to a score: the score is Σ part / Σ whole over all frames. One element
/// of each where only totals are known.
struct RatioSeries {
  std::vector<double> part, whole;
};

/// 95 % interval of Σ part / Σ whole; nothing where it cannot be told (whole is zero, or too little data).
///
/// Frames may depend on their neighbours, and frames whose part and whole are zero count as time. From
/// kManySequences sequences on, the uncertainty is the scatter between the sequences; below, that of the slow
/// waves within them (statistics/long_run.h). Where every part lies between 0 and its whole, the interval is
/// symmetric in log odds and stays within [0, 1]. "Too little": fewer than 5 outages (stretches below the mean)
/// in all, or sequences too short for how slowly they change; of many sequences, fewer than 3 on either side of
/// the ratio. Coverage: docs/statistics.md.
/// Every sequence has as many wholes as parts.
std::optional<Interval> ratio_interval(std::span<const RatioSeries> sequences);

/// 95 % interval of the difference a - b of two such ratios on the same frames: paired, so that what both share
/// cancels. As many sequences in both, of the same lengths.
std::optional<Interval> difference_interval(std::span<const RatioSeries> a, std::span<const RatioSeries> b);

/// A value at a place in its sequence.
struct FramedValue {
  std::size_t frame = 0;
  double value = 0;
};

/// 95 % interval of the quantile at `share` in (0, 1) of values that depend on their neighbours: of the share
/// of values at or below it, mapped back through the values (Woodruff 1952). Several values of one frame, of
/// repetitions or of several targets, count together: they are no further frames. Nothing where that share's
/// interval cannot be told.
std::optional<Interval> quantile_interval(std::span<const std::vector<FramedValue>> values_by_sequence,
                                          double share);

}  // namespace relock
