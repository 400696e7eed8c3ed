#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "cli/runs/folder.h"

namespace relock {

/// Whether yardsticks are shown where nobody names methods.
enum class Yardsticks : std::uint8_t { too, if_alone };

/// Places of the runs to be shown: those of the methods that are named, in that order, else all.
std::vector<std::size_t> chosen_runs(const StoredComparison& comparison,
                                     const std::vector<std::string>& methods, Yardsticks yardsticks);

/// Throws Error when a method is named that has no run in any of them.
void check_methods(const std::vector<StoredComparison>& all, const std::vector<std::string>& methods);

/// The one comparison that there is. Throws Error, saying what "a figure" or the like is of, when there are several.
StoredComparison only_one(std::vector<StoredComparison> all, std::string_view what);

}  // namespace relock
