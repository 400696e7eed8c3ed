#pragma once

#include <optional>
#include <span>
#include <vector>

#include "eval/visible_time.h"

namespace relock {

/// A stretch of visible time over which the newest Hit ages from `from_s` to `from_s + length_s`.
struct AgeStretch {
  double from_s = 0;  ///< infinite before the first Hit
  double length_s = 0;
};

/// How old the newest of the `fixes` (rising capture times) is, all through visible time.
std::vector<AgeStretch> fix_ages(std::span<const VisibleInterval> visible, std::span<const Time> fixes);

/// Fix age over visible time (metrics.md section 6), s. It may be infinite: no Hit had been made by then. Empty
/// values: no visible time.
struct FixAge {
  std::optional<double> median_s, p95_s, max_s;
};
FixAge fix_age(std::span<const AgeStretch> stretches);

}  // namespace relock
