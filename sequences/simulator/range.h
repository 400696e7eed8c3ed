#pragma once

#include <fmt/format.h>

#include <string_view>

#include "core/error.h"
#include "core/random.h"

namespace relock::simulator {

/// Throws Error unless a quantity of a plan is from `least` to `most`; not a number is not.
inline void check_range(std::string_view what, double value, double least, double most) {
  if (!(value >= least && value <= most))
    throw Error(fmt::format("{} is {}; it must be from {} to {}", what, value, least, most));
}

/// What a quantity is drawn from, evenly.
struct Range {
  double low = 0, high = 0;
  friend bool operator==(const Range&, const Range&) = default;
};

inline double drawn(Random& random, const Range& range) {
  return range.low + (range.high - range.low) * random.uniform();
}

/// Throws Error unless both ends are from `least` to `most` and in order.
inline void check_range(std::string_view what, const Range& range, double least, double most) {
  check_range(what, range.low, least, most);
  check_range(what, range.high, range.low, most);
}

}  // namespace relock::simulator
