#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "cli/json_text.h"
#include "cli/pooled_runs.h"

namespace relock::reports {

/// What losses came with, and how long a start holds, of each group of runs that may be compared: for each method, how
/// many of the steps from one delivered frame to the next were taken with the target held and how many of them lost it,
/// by gap, blur and displacement; the sentences of `relock attribute`; and the curve and sentence of `relock survival`. `jobs`: methods at a time; the answer is the same for any number.
Json why_json(const std::vector<PooledRuns>& groups, int jobs);

/// The picture that `relock map` left in a folder of results, as a data: URL; nothing where it drew none.
std::optional<std::string> map_picture(const std::filesystem::path& results);

}  // namespace relock::reports
