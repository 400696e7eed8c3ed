#pragma once

#include <optional>
#include <vector>

#include "cli/runs/folder.h"

namespace relock {

/// Whether a target is to be shown: `only` names the one that was asked for, if any.
bool wanted(const Target& target, const std::optional<TargetId>& only);

/// Throws Error when no recording has the target that was asked for.
void check_target(const std::vector<StoredComparison>& all, const std::optional<TargetId>& only);

}  // namespace relock
