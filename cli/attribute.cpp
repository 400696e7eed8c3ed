// `relock attribute`: what losses come from, or at least go with.

#include <fmt/format.h>

#include "cli/json_text.h"
#include "cli/pooled_runs.h"
#include "cli/verbs.h"

namespace relock {
namespace {

Attribution attribution_of(const PooledRuns& group, const PooledMethod& method) {
  return attribute(transitions(method), group.gaps == "none" ? Gaps::recorded : Gaps::injected);
}

void print_group(const PooledRuns& group) {
  for (const PooledMethod& method : group.methods) {
    if (method.yardstick) continue;
    const Attribution found = attribution_of(group, method);
    fmt::print("  {}: {}\n", method.method, sentence(found));
    for (const Effect& effect : found.effects) fmt::print("    {}\n", sentence(effect));
  }
}

std::string_view name(Effect::Covariate covariate) {
  switch (covariate) {
    case Effect::Covariate::injected_slots:
      return "injected_slots";
    case Effect::Covariate::recorded_slots:
      return "recorded_slots";
    case Effect::Covariate::skipped_slots:
      return "skipped_slots";
    case Effect::Covariate::blur:
      return "blur_tenths_d";
    case Effect::Covariate::displacement:
      return "displacement_tenths_d";
  }
  return "";
}

Json method_json(const PooledRuns& group, const PooledMethod& method) {
  const Attribution found = attribution_of(group, method);
  Json effects = Json::array();
  for (const Effect& e : found.effects)
    effects.push_back({{"covariate", name(e.covariate)},
                       {"odds_ratio", number(e.odds_ratio)},
                       {"interval", interval(e.interval)},
                       {"claim", e.because ? "because" : "goes with"}});
  return {{"method", method.method},
          {"sequences", found.sequences},
          {"transitions", found.transitions},
          {"losses", found.losses},
          {"too_few", found.too_few == TooFew::losses || found.too_few == TooFew::variation},
          {"converged", found.too_few != TooFew::not_converged},
          {"effects", effects}};
}

}  // namespace

int attribute(const ResultsArguments& arguments) { return tell_pooled(arguments, print_group, method_json); }

}  // namespace relock
