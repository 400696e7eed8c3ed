#include "cli/pooled_runs.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/comparison.h"
#include "cli/readable.h"
#include "cli/runs/copies.h"

namespace relock {
namespace {

/// Runs from all anchors of protocol multistart belong together.
Showing pooled_showing(const RunRecord& record) {
  Showing showing = record.showing();
  showing.anchor.reset();
  return showing;
}

PooledRuns& group_of(std::vector<PooledRuns>& groups, const RunRecord& record, const Gate& gate) {
  const Showing showing = pooled_showing(record);
  const auto found = std::find_if(groups.begin(), groups.end(), [&](const PooledRuns& group) {
    return group.showing == showing && group.gaps == record.gaps && group.gate == gate;
  });
  return found != groups.end() ? *found : groups.emplace_back(PooledRuns{showing, record.gaps, gate, {}});
}

PooledMethod& method_of(std::vector<PooledMethod>& methods, const RunRecord& record) {
  const auto found = std::find_if(methods.begin(), methods.end(),
                                  [&](const PooledMethod& m) { return m.method == record.method; });
  return found != methods.end() ? *found
                                : methods.emplace_back(PooledMethod{record.method, record.yardstick, {}});
}

Json group_json(const PooledRuns& group, Json methods) {
  return {{"protocol", to_string(group.showing.protocol)},
          {"gaps", group.gaps},
          {"gate", to_string(group.gate)},
          {"real_time", group.showing.real_time},
          {"latency", group.showing.latency},
          {"methods", std::move(methods)}};
}

}  // namespace

std::vector<TransitionRun> transitions(const PooledMethod& method) {
  std::vector<TransitionRun> runs;
  std::vector<std::string> sequences;
  for (const auto& [comparison, run, evaluation] : method.runs) {
    const Recording& recording = comparison->recording;
    auto sequence = std::find(sequences.begin(), sequences.end(), recording.name);
    if (sequence == sequences.end()) sequence = sequences.insert(sequence, recording.name);
    for (std::size_t t = 0; t < recording.targets.size(); ++t)
      runs.push_back({static_cast<std::size_t>(sequence - sequences.begin()),
                      transitions(recording, run->trajectory, t, evaluation.targets[t])});
  }
  return runs;
}

std::vector<TrackingLifetime> lifetimes(const PooledMethod& method) {
  std::vector<TrackingLifetime> all;
  for (const auto& [comparison, run, evaluation] : method.runs)
    for (const TargetTimeline& timeline : evaluation.targets) {
      const auto own = tracking_lifetimes(comparison->recording, run->trajectory, timeline);
      all.insert(all.end(), own.begin(), own.end());
    }
  return all;
}

std::vector<PooledRuns> pooled(const std::vector<StoredComparison>& all,
                               const std::optional<std::string>& asked) {
  std::vector<PooledRuns> groups;
  KnownRuns known;
  for (const StoredComparison& comparison : all) {
    const Gate gate = gate_of(comparison, asked);
    for (const StoredRun& run : comparison.runs) {
      if (!known.first(run, gate)) continue;
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
  return fmt::format("{}, {}, gate {}", spoken(runs.showing),
                     runs.gaps == "none" ? "as recorded" : "gaps " + runs.gaps, to_string(runs.gate));
}

int tell_pooled(const ResultsArguments& arguments, const std::function<void(const PooledRuns&)>& print,
                const std::function<Json(const PooledRuns&, const PooledMethod&)>& json_of) {
  return with_readable(find_results(arguments.folder), [&](const std::vector<StoredComparison>& all) {
    Json groups = Json::array();
    bool first = true;
    for (const PooledRuns& group : pooled(all, arguments.gate)) {
      if (arguments.json) {
        Json methods = Json::array();
        for (const PooledMethod& method : group.methods) methods.push_back(json_of(group, method));
        groups.push_back(group_json(group, std::move(methods)));
      } else {
        fmt::print("{}{}\n", first ? "" : "\n", heading(group));
        print(group);
      }
      first = false;
    }
    if (arguments.json) fmt::print("{}", json_text(groups));
  });
}

}  // namespace relock
