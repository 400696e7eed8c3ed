#pragma once

#include <fmt/format.h>

#include <string_view>

#include "core/error.h"

namespace relock::simulator {

/// Throws Error unless a quantity of a plan is from `least` to `most`; not a number is not.
inline void check_range(std::string_view what, double value, double least, double most) {
  if (!(value >= least && value <= most))
    throw Error(fmt::format("{} is {}; it must be from {} to {}", what, value, least, most));
}

}  // namespace relock::simulator
