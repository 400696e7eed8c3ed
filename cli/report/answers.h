#pragma once

#include <string>
#include <vector>

#include "cli/json_text.h"
#include "cli/scores/tables.h"

namespace relock::reports {

/// The tables at the top: those that `relock score --cost` prints, their methods by availability, the best first.
/// `tables`: of each conditions one of all targets pooled, and those of single targets, if any.
Json answers_json(const std::vector<JudgedTable>& tables);

/// A table in two or three sentences: who had the target for longest, what was lost, and what a yardstick makes of it.
std::vector<std::string> in_words(const JudgedTable& pooled);

}  // namespace relock::reports
