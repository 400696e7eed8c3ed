#pragma once

#include <span>
#include <string>
#include <string_view>

namespace relock {

/// The known name nearest to what was typed, for "did you mean …?"; empty when none is near (more than a
/// third of the letters would have to change).
std::string nearest_name(std::string_view typed, std::span<const std::string> known);

/// " (did you mean "csrt"?)" ready to append to an error, or nothing.
std::string did_you_mean(std::string_view typed, std::span<const std::string> known);

}  // namespace relock
