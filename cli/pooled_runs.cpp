#include "cli/pooled_runs.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/comparison.h"

namespace relock {
namespace {

PooledRuns& group_of(std::vector<PooledRuns>& groups, const RunRecord& record, const Gate& gate) {
  const auto found = std::find_if(groups.begin(), groups.end(), [&](const PooledRuns& group) {
    return group.protocol == record.protocol && group.gaps == record.gaps && group.gate == gate;
  });
  return found != groups.end() ? *found
                               : groups.emplace_back(PooledRuns{record.protocol, record.gaps, gate, {}});
}

PooledMethod& method_of(std::vector<PooledMethod>& methods, const RunRecord& record) {
  const auto found = std::find_if(methods.begin(), methods.end(),
                                  [&](const PooledMethod& m) { return m.method == record.method; });
  return found != methods.end() ? *found
                                : methods.emplace_back(PooledMethod{record.method, record.yardstick, {}});
}

}  // namespace

std::vector<PooledRuns> pooled(const std::vector<StoredComparison>& all,
                               const std::optional<std::string>& asked) {
  std::vector<PooledRuns> groups;
  for (const StoredComparison& comparison : all) {
    const Gate gate = gate_of(comparison, asked);
    for (const StoredRun& run : comparison.runs) {
      PooledRuns& group = group_of(groups, run.record, gate);
      method_of(group.methods, run.record)
          .runs.push_back({&comparison, &run, evaluate(comparison.recording, run.trajectory, gate)});
    }
  }
  for (PooledRuns& group : groups)
    std::stable_sort(group.methods.begin(), group.methods.end(),
                     [](const PooledMethod& a, const PooledMethod& b) { return a.yardstick < b.yardstick; });
  return groups;
}

std::string heading(const PooledRuns& runs) {
  return fmt::format("protocol {}, {}, gate {}", to_string(runs.protocol),
                     runs.gaps == "none" ? "as recorded" : "gaps " + runs.gaps, to_string(runs.gate));
}

}  // namespace relock
