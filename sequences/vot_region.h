#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/geometry.h"

namespace relock {

/// A line of a VOT ground truth file (sequences/vot.h); nothing where the target is not there.
/// Throws Error at the line on what is no region, and on a point, which has no outline.
std::optional<Outline> vot_region(std::string_view line, const std::string& file, std::size_t number);

}  // namespace relock
