#pragma once

#include <string>

#include "cli/runs/folder.h"
#include "eval/scores.h"

namespace relock {

/// scores.json of one run: its gate, the scores of all targets pooled and of each. n/a is null.
std::string scores_json(const StoredRun& run, const Recording& recording, const Gate& gate,
                        const ScoreSheet& sheet);

/// Several scores.json as one array.
std::string json_array(const std::vector<std::string>& objects);

}  // namespace relock
