#include "cli/runs/missing.h"

#include <fmt/format.h>

#include <map>

#include "cli/runs/pool.h"
#include "cli/runs/truth.h"

namespace relock {
namespace {

constexpr int kMethodFailed = 1, kInputAtFault = 2, kInterrupted = 130;

}  // namespace

int make_missing_runs(const Matrix& matrix, int jobs) {
  for (const Sequence& sequence : matrix.sequences)
    store_truth(matrix.runs.front().folder.parent_path().parent_path().parent_path(), sequence.recording,
                sequence.fingerprint);
  std::vector<std::size_t> todo;
  for (std::size_t run = 0; run < matrix.runs.size(); ++run)
    if (!matrix.runs[run].there) todo.push_back(run);
  std::size_t complete = matrix.runs.size() - todo.size();
  std::map<std::string, std::size_t> failures;  // by method: so many runs
  std::optional<std::string> fault;
  PoolReport report;
  report.finished = [&](std::size_t run, const FinishedRun& done) {
    ++complete;
    if (!done.record.failures.empty()) ++failures[matrix.runs[run].method.text];
  };
  report.not_made = [&](std::size_t, const std::string& why) { fault = why; };
  if (!make_runs(matrix, todo, {}, jobs, report)) {
    fmt::print(stderr,
               "relock: interrupted; {} of {} runs are complete and kept, and the same command goes on from "
               "there\n",
               complete, matrix.runs.size());
    return kInterrupted;
  }
  for (const auto& [method, runs] : failures)
    fmt::print(stderr, "relock: {} failed in {} runs, and is scored as failed from there on\n", method, runs);
  if (fault) fmt::print(stderr, "relock: {}\n", *fault);
  return fault ? kInputAtFault : failures.empty() ? 0 : kMethodFailed;
}

}  // namespace relock
