#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/runs/folder.h"

namespace relock {

// What verbs do with results of which some cannot be read: they tell of the others, and then of those.

/// Tells on stderr what was left out, a sentence each, after all that was printed. Returns the exit status: 2 when
/// anything was left out.
int tell_left_out(const std::vector<std::string>& sentences);

using UseResults = std::function<void(std::vector<StoredComparison> results)>;

/// Gives what can be read of `found` to `use`, unless it is nothing. Then, or when `use` throws, tells what was left
/// out. Returns the exit status.
int with_readable(const std::vector<FoundComparison>& found, const UseResults& use);

}  // namespace relock
