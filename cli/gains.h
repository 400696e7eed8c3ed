#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/arms.h"
#include "cli/runs/folder.h"
#include "eval/scores/gain.h"

namespace relock {

/// One tracker and the combinations of it: a row of the table.
struct GainRow {
  std::string tracker;               ///< as it would be typed; a detector without combinations has a row, too
  bool deterministic = true;         ///< all of the row
  std::vector<std::string> methods;  ///< the tracker alone first
  std::vector<std::string> columns;  ///< of each method: "alone", "guarded(T,ring)"
  std::size_t pairs = 0;             ///< pairs of runs that all methods of the row have
  std::size_t known_pairs = 0;       ///< of the tracker alone
  FamilyGain gain;                   ///< members as `methods`
};

/// What combinations gain over the tracker in them, with one gap pattern and without.
struct GainExperiment : PairedConditions {
  std::vector<GainRow> rows;
  std::vector<std::string> columns;           ///< of all rows, as they stand in the table
  std::vector<std::string> alone_is_missing;  ///< combinations whose tracker alone was not run
};

/// The experiments among `comparisons` (cli/arms.h). `gate`: else the one by which resets were judged, else
/// centre. Throws Error when no run has both arms, or no combination stands beside its tracker.
std::vector<GainExperiment> gain_experiments(const std::vector<StoredComparison>& comparisons,
                                             const std::optional<std::string>& gate);

/// The score that --score names: locked-share, recognition, availability, losses. Throws Error for another word.
CostScore gain_score(const std::string& word);

/// One table, for people.
std::string gain_text(const GainExperiment& experiment, CostScore score);
/// One JSON object for each experiment and method, with all scores.
std::string gain_json(const std::vector<GainExperiment>& experiments);

}  // namespace relock
