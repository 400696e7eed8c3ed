#pragma once

#include <algorithm>
#include <span>

namespace relock {

/// Part of the values that is greater than the threshold, not equal: OTB and GOT-10k.
inline double share_above(std::span<const double> values, double threshold) {
  const auto above =
      std::count_if(values.begin(), values.end(), [&](double value) { return value > threshold; });
  return static_cast<double>(above) / static_cast<double>(values.size());
}

/// Part of the values that is at most the limit.
inline double share_within(std::span<const double> values, double limit) {
  const auto within =
      std::count_if(values.begin(), values.end(), [&](double value) { return value <= limit; });
  return static_cast<double>(within) / static_cast<double>(values.size());
}

}  // namespace relock
