#pragma once

#include <string>
#include <vector>

#include "cli/scores/judged.h"
#include "cli/table.h"

namespace relock {

/// A table with its methods' scores.
struct JudgedTable {
  ScoreTable table;
  std::vector<JudgedMethod> methods;
};

/// Of all that was added, in order of conditions; of the same conditions, as `pools` stand.
std::vector<JudgedTable> judged_tables(std::vector<ScorePool> pools);
/// Leaves out the tables of single targets where several recordings were pooled: with one recording its targets
/// matter; with several, all of them together.
void keep_targets_of_single_recordings(std::vector<JudgedTable>& tables);

/// "klahaag, gaps paper (seed 1), protocol once, gate centre 0.25 D, hold 0.5 D".
std::string heading(const ScoreTable& table);

/// Who keeps the target: recognition, availability, locked share, losses and recovery, with intervals.
Table keeping_table(const JudgedTable& judged);
/// What it says and how exactly: precision, silent share, fix age, localization.
Table exactness_table(const JudgedTable& judged);
/// How well methods tell the blur; those that told none are left out.
Table blur_table(const JudgedTable& judged);
/// What methods saw of the recording in real time, what a controller had of their answers, and what was lost to
/// slowness, gaps and failure.
Table real_time_table(const ScoreTable& table);
/// What methods cost: wall and CPU time of a frame, the share of frames skipped, and peak memory.
Table cost_table(const JudgedTable& judged);
/// Recognition, a column for each bin; all tables have the same conditions.
Table bins_table(const std::vector<const JudgedTable*>& bins);

/// What the columns mean.
std::string_view table_footnote();
std::string_view blur_footnote();
std::string_view real_time_footnote();

}  // namespace relock
