#pragma once

#include <string>
#include <vector>

#include "cli/scores/tables.h"

namespace relock {

/// scores.json of one run: its own scores, without intervals.
std::string scores_json(const StoredRun& run, const Recording& recording, const Gate& gate,
                        const ScoreSheet& sheet);

/// All tables: {"tables": […]}, each with its conditions and its methods' scores, intervals and standings.
std::string tables_json(const std::vector<JudgedTable>& tables);

/// All tables, one row for each score of each method: protocol, gaps, gate, real_time, latency, by, group,
/// method, score, value, low, high, standing. Empty: n/a, or no interval; inf: infinite.
std::string tables_csv(const std::vector<JudgedTable>& tables);

}  // namespace relock
