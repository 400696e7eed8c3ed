#pragma once

#include <optional>
#include <span>
#include <vector>

#include "eval/judgement/visible_time.h"

namespace relock {

/// A stretch of visible time over which the newest Hit ages from `from` to `from + length`. Whole nanoseconds: a
/// share of time that is met exactly must not be missed by rounding.
struct AgeStretch {
  std::optional<Duration> from;  ///< nothing before the first Hit
  Duration length{0};
};

/// How old the newest of the `fixes` (rising capture times) is, all through visible time.
std::vector<AgeStretch> fix_ages(std::span<const VisibleInterval> visible, std::span<const Time> fixes);

/// Fix age over visible time (metrics.md section 6), s. It may be infinite: no Hit had been made by then. Empty
/// values: no visible time. A percentile is the least age that is not exceeded for its share of the time.
struct FixAge {
  std::optional<double> median_s, p95_s, max_s;
};
FixAge fix_age(std::span<const AgeStretch> stretches);

}  // namespace relock
