#pragma once

#include <string>
#include <vector>

#include "cli/runs/folder.h"
#include "eval/scores/scores.h"

namespace relock {

/// The runs of a comparison, judged and scored by one gate.
struct ScoredComparison {
  StoredComparison stored;
  Gate gate;
  std::vector<Evaluation> evaluations;            ///< of each run
  std::vector<std::vector<TargetTally>> tallies;  ///< of each run and target
  std::vector<ScoreSheet> sheets;                 ///< of each run
  /// For each run and target, the Hits common to all methods asked about the target, yardsticks apart.
  std::vector<std::vector<std::vector<Fix>>> common;
};

ScoredComparison scored(StoredComparison stored, const Gate& gate);

/// The gate to judge runs by: `asked`, else the one by which protocol reset judged losses, else centre.
/// Throws Error when resets were judged by another one than `asked`.
Gate gate_of(const StoredComparison& comparison, const std::optional<std::string>& asked);

/// The place of a frame of a run in the recording, whichever way it was played.
std::size_t recorded_frame(const StoredComparison& comparison, const StoredRun& run, std::size_t frame);

/// Where and why the recording could not be read on, if that is so.
std::optional<std::string> end_of_recording(const StoredComparison& comparison);

/// "klahaag, as recorded, protocol once, gate centre 0.25 D, hold 0.5 D".
std::string heading(const StoredComparison& comparison, const Gate& gate);

}  // namespace relock
