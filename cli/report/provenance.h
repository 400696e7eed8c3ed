#pragma once

#include <string>
#include <vector>

#include "cli/json_text.h"
#include "cli/runs/folder.h"

namespace relock::reports {

/// What produced each run, and the commands that make all of it again. No path of this machine stands in it, but what
/// was typed as an option.
Json provenance_json(const std::vector<StoredComparison>& all, const std::string& report_command);

/// A word as a shell takes it: quoted where that is needed.
std::string shell_word(const std::string& word);

}  // namespace relock::reports
