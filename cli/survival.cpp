// `relock survival`: how long methods hold a target that they were given, beside the seed paper's claim.

#include <fmt/format.h>

#include <optional>
#include <string>

#include "cli/json_text.h"
#include "cli/pooled_runs.h"
#include "cli/verbs.h"

namespace relock {
namespace {

TrackingSurvivals survival_of(const PooledMethod& method) { return tracking_survival(lifetimes(method)); }

Json to_json(const TrackingSurvival& s, double claim) {
  return {{"median", number(s.median)},
          {"median_interval", interval(s.median_interval)},
          {"at", claim},
          {"still_hold", number(s.at_claim)},
          {"still_hold_interval", interval(s.at_claim_interval)},
          {"follow_up", s.follow_up}};
}

/// Why nothing is told of the runs of `group`, if that is so. By protocol vot a method is started again after one
/// failed frame, which is no loss by the rules, so every lock would seem to have been cut off and none to have failed.
std::optional<std::string> left_out(const PooledRuns& group) {
  if (group.showing.protocol != Protocol::vot) return {};
  return "protocol vot: its failures are no losses; see `relock compatibility`";
}

void print_group(const PooledRuns& group) {
  if (const auto why = left_out(group)) return fmt::print("  left out: {}\n", *why);
  std::string claims;
  for (const PooledMethod& method : group.methods) {
    const TrackingSurvivals survival = survival_of(method);
    fmt::print("  {} {}\n", method.method, sentence(survival));
    if (method.yardstick || survival.starts == 0) continue;
    claims +=
        fmt::format("{} {} {}", claims.empty() ? "" : ",", method.method, to_string(judge_claim(survival)));
  }
  fmt::print(
      "  \"fails again after about {:.0f} frames, within {:.0f} seconds\" (the paper, of its own "
      "tracker):{}\n",
      kClaimFrames, kClaimSeconds, claims.empty() ? " no method was given the target" : claims);
}

Json method_json(const PooledRuns& group, const PooledMethod& method) {
  if (const auto why = left_out(group)) return {{"method", method.method}, {"left_out", *why}};
  const TrackingSurvivals s = survival_of(method);
  return {{"method", method.method},
          {"starts", s.starts},
          {"losses", s.losses},
          {"frames", to_json(s.frames, kClaimFrames)},
          {"seconds", to_json(s.seconds, kClaimSeconds)},
          {"paper_claim", to_string(judge_claim(s))}};
}

}  // namespace

int survival(const ResultsArguments& arguments) { return tell_pooled(arguments, print_group, method_json); }

}  // namespace relock
