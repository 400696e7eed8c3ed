// `relock survival`: how long methods hold a target that they were given, beside the seed paper's claim.

#include <fmt/format.h>

#include "cli/json_text.h"
#include "cli/pooled_runs.h"
#include "cli/verbs.h"
#include "eval/tracking_survival.h"

namespace relock {
namespace {

TrackingSurvivals survival_of(const PooledMethod& method) {
  std::vector<TrackingLifetime> all;
  for (const auto& [comparison, run, evaluation] : method.runs) {
    for (const TargetTimeline& timeline : evaluation.targets) {
      const auto own = tracking_lifetimes(comparison->recording, run->trajectory, timeline);
      all.insert(all.end(), own.begin(), own.end());
    }
  }
  return tracking_survival(all);
}

Json to_json(const TrackingSurvival& s, double claim) {
  return {{"median", number(s.median)},
          {"median_interval", interval(s.median_interval)},
          {"at", claim},
          {"still_hold", number(s.at_claim)},
          {"still_hold_interval", interval(s.at_claim_interval)},
          {"follow_up", s.follow_up}};
}

void print_group(const PooledRuns& group) {
  fmt::print("{}\n", heading(group));
  for (const PooledMethod& method : group.methods)
    fmt::print("  {} {}\n", method.method, sentence(survival_of(method)));
  fmt::print(
      "  \"fails again after about {:.0f} frames, within {:.0f} seconds\" (the paper, of its own tracker):",
      kClaimFrames, kClaimSeconds);
  bool first = true;
  for (const PooledMethod& method : group.methods) {
    const TrackingSurvivals survival = survival_of(method);
    if (method.yardstick || survival.starts == 0) continue;
    fmt::print("{} {} {}", first ? "" : ",", method.method, to_string(judge_claim(survival)));
    first = false;
  }
  fmt::print("{}\n", first ? " no method was given the target" : "");
}

Json group_json(const PooledRuns& group) {
  Json methods = Json::array();
  for (const PooledMethod& method : group.methods) {
    const TrackingSurvivals s = survival_of(method);
    methods.push_back({{"method", method.method},
                       {"starts", s.starts},
                       {"losses", s.losses},
                       {"frames", to_json(s.frames, kClaimFrames)},
                       {"seconds", to_json(s.seconds, kClaimSeconds)},
                       {"paper_claim", to_string(judge_claim(s))}});
  }
  return {{"protocol", to_string(group.protocol)},
          {"gaps", group.gaps},
          {"gate", to_string(group.gate)},
          {"methods", methods}};
}

}  // namespace

int survival(const SurvivalArguments& arguments) {
  const auto all = read_results(arguments.folder);
  Json json = Json::array();
  bool first = true;
  for (const PooledRuns& group : pooled(all, arguments.gate)) {
    if (arguments.json) {
      json.push_back(group_json(group));
      continue;
    }
    if (!first) fmt::print("\n");
    first = false;
    print_group(group);
  }
  if (arguments.json) fmt::print("{}", json_text(json));
  return 0;
}

}  // namespace relock
