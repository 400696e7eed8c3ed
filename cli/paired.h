#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/arms.h"
#include "cli/runs/folder.h"
#include "eval/scores/paired.h"

namespace relock {

/// What one gap pattern cost the methods.
struct GapExperiment : PairedConditions {
  struct MethodCost {
    std::string method;
    bool yardstick = false;
    bool deterministic = true;
    GapCost cost;
  };
  std::vector<MethodCost> methods;  ///< yardsticks last
};

/// The experiments that are whole among `comparisons`: of every gap pattern the runs that were made as
/// recorded, too (cli/arms.h). `gate`: else the one by which resets were judged, else centre. Throws Error when
/// no run has both arms.
std::vector<GapExperiment> gap_experiments(const std::vector<StoredComparison>& comparisons,
                                           const std::optional<std::string>& gate);

/// One table, for people.
std::string cost_text(const GapExperiment& experiment);
/// One JSON object for each experiment and method.
std::string cost_json(const std::vector<GapExperiment>& experiments);

/// Prints the table of every experiment among `comparisons`: `relock cost`, and the end of
/// `relock run --paired`.
void print_cost_of_gaps(const std::vector<StoredComparison>& comparisons,
                        const std::optional<std::string>& gate);

}  // namespace relock
