#pragma once

#include <string>
#include <vector>

#include "cli/scores/tables.h"

namespace relock {

/// What qualifies the scores of the i-th method of a table, in sentences.
std::vector<std::string> remarks(const JudgedTable& judged, std::size_t i);

/// Prints tables for a person: those of the same conditions under one heading, which the table of all targets pooled
/// must be among, and what qualifies the scores below. In text, then `ends`, of recordings that could not be read
/// on, and what the columns mean.
void print_tables(const std::vector<JudgedTable>& tables, TableFormat format,
                  const std::vector<std::string>& ends);

}  // namespace relock
