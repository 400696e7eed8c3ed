#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/json_text.h"
#include "cli/runs/folder.h"
#include "eval/scores/paired.h"

namespace relock {

// The two arms of paired runs, found among results: as recorded, and with gaps.

/// The runs of one method in both arms.
struct Arms {
  const StoredComparison& conditions;  ///< of the arm with gaps
  const StoredRun& without;
  const StoredRun& with;
};

/// Of each gap pattern, showing and gate the runs with gaps that have an arm as recorded, with the same recording,
/// seed, anchor, real time and latency. Each is paired with its own run as recorded, that of the same results folder
/// before one of another. The arms point into `comparisons`. Throws Error when no run has both arms.
std::vector<std::vector<Arms>> arms_by_pattern(const std::vector<StoredComparison>& comparisons);

/// Runs with gaps that have no arm as recorded, and so no place in an experiment: a sentence on each comparison that
/// has some, which names the methods unless it is all of them.
std::vector<std::string> without_a_pair(const std::vector<StoredComparison>& comparisons);

/// What a paired experiment is about: one gap pattern, over recordings and seeds, all shown in the same way.
struct PairedConditions {
  std::string gaps;
  Showing showing;
  Gate gate;
  std::vector<std::string> recordings;
  std::vector<std::uint64_t> seeds;
};
/// Of arms of one pattern, of which there are some. `gate`: else the one by which resets were judged, else centre.
PairedConditions paired_conditions(const std::vector<Arms>& all, const std::optional<std::string>& gate);
/// "seeds 1, 2, protocol once, gate centre 0.25 D, hold 0.5 D"
std::string to_string(const PairedConditions& conditions);
Json json_of(const PairedConditions& conditions);

/// What went into the runs of a comparison, the method apart.
const RunRecord& conditions_of(const StoredComparison& comparison);

/// A pair as long as the shorter of its arms, where one was cut short.
struct EquallyLong {
  Recording recording;
  Trajectory without, with;
};
EquallyLong equally_long(const Arms& arms);

}  // namespace relock
