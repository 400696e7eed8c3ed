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
std::optional<Interval> ratio_interval(std::span<const RatioSeries> sequences);

/// 95 % interval of the difference a - b of two such ratios on the same frames (paired: the same resamples for
/// both).
std::optional<Interval> difference_interval(std::span<const RatioSeries> a, std::span<const RatioSeries> b);

}  // namespace relock
