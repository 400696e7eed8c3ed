#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/runs/folder.h"
#include "eval/evaluation.h"

namespace relock {

/// The runs of one method under one protocol and gap pattern, over recordings and seeds.
struct PooledMethod {
  struct Run {
    const StoredComparison* comparison;
    const StoredRun* run;
    Evaluation evaluation;
  };
  std::string method;
  bool yardstick = false;
  std::vector<Run> runs;
};
/// All methods that may be compared with one another: the same protocol, gap pattern and gate.
struct PooledRuns {
  Protocol protocol;
  std::string gaps;  ///< "none" as recorded
  Gate gate;
  std::vector<PooledMethod> methods;  ///< as they stand in the results, yardsticks last
};

/// Sorts and evaluates the runs of `all`, which must outlive the answer. `gate`: as for gate_of
/// (cli/comparison.h).
std::vector<PooledRuns> pooled(const std::vector<StoredComparison>& all,
                               const std::optional<std::string>& gate);

/// "protocol reset, gaps paper, gate centre 0.25 D, hold 0.5 D".
std::string heading(const PooledRuns& runs);

}  // namespace relock
