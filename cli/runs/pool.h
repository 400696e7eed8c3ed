#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/runs/worker.h"

namespace relock {

/// What the pool tells of its runs, in the order in which they end.
struct PoolReport {
  std::function<void(std::size_t run, const FinishedRun&)> finished;
  /// It could not be made: a fault of the recording, not of the method.
  std::function<void(std::size_t run, const std::string& why)> not_made;
};

/// Makes the runs `todo` of the matrix, `jobs` at a time, each in a process of its own. Shows progress on a
/// terminal. Returns whether all were made: not so after an interrupt (Ctrl-C, SIGTERM, SIGHUP), which ends
/// the runs under way. An exception from `report` ends them, too.
bool make_runs(const Matrix& matrix, const std::vector<std::size_t>& todo, const RunLimits& limits, int jobs,
               const PoolReport& report);

/// "3 min 20 s".
std::string spoken_time(double seconds);

}  // namespace relock
