#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/json_text.h"
#include "cli/runs/folder.h"
#include "cli/verbs.h"
#include "eval/judgement/evaluation.h"
#include "eval/scores/attribution.h"
#include "eval/scores/tracking_survival.h"

namespace relock {

/// The runs of one method that were made alike, over recordings, seeds and anchors.
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
/// Its steps with the target held, run by run and target by target.
std::vector<TransitionRun> transitions(const PooledMethod& method);
/// How long it held targets that it was given.
std::vector<TrackingLifetime> lifetimes(const PooledMethod& method);

/// All methods that may be compared with one another: shown recordings in the same way, with the same gap pattern,
/// and judged by the same gate.
struct PooledRuns {
  Showing showing;   ///< without an anchor: all of them are pooled
  std::string gaps;  ///< "none" as recorded
  Gate gate;
  std::vector<PooledMethod> methods;  ///< as they stand in the results, yardsticks last
};

/// Sorts and evaluates the runs of `all`, which must outlive the answer. `gate`: as for gate_of
/// (cli/comparison.h).
std::vector<PooledRuns> pooled(const std::vector<StoredComparison>& all,
                               const std::optional<std::string>& gate);

/// "protocol reset, gaps paper, gate centre 0.25 D, hold 0.5 D";
/// "protocol once, real time latest, latency constant(20ms), as recorded, gate …".
std::string heading(const PooledRuns& runs);

/// The verbs that tell of pooled runs. Reads those that were asked for and shows each group to `print`, or prints as
/// JSON what `json_of` tells of each method in it. Returns the exit status: 2 when a run could not be read.
int tell_pooled(const ResultsArguments& arguments, const std::function<void(const PooledRuns&)>& print,
                const std::function<Json(const PooledRuns&, const PooledMethod&)>& json_of);

}  // namespace relock
