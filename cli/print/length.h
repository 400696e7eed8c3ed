#pragma once

#include <string_view>

namespace relock {

/// Metres of "150mm", "15cm", "0.15m" or "6in". `what` is what errors call it ("--size"). Throws Error for
/// anything else, and unless the length is from 1 mm to 10 m.
double parse_length_m(std::string_view text, std::string_view what);

}  // namespace relock
