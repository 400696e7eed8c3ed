// What cli/compare/changes.h tells, as JSON.

#include <algorithm>

#include "cli/compare/changes.h"
#include "cli/json_text.h"

namespace relock {
namespace {

/// Keys have underscores, as in scores.json.
std::string key_of(ComparedScore score) {
  std::string name(name_of(score));
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

Json json_of(ComparedScore which, const ScoreChange& score) {
  const int verdict = verdict_on(which, score.interval);
  return {{"a", number(score.before)},
          {"b", number(score.after)},
          {"difference", number(score.difference)},
          {"interval", interval(score.interval)},
          {"verdict", verdict < 0   ? "worse"
                      : verdict > 0 ? "better"
                                    : "untold"}};
}

Json json_of(const std::optional<Loss>& loss, const std::optional<double>& onset_s) {
  if (!loss) return {};
  return {{"onset_s", number(onset_s)},
          {"frames", {loss->last_good, loss->first_lost}},
          {"kind", to_string(loss->kind)},
          {"ended_by", to_string(loss->end)},
          {"end_frame", loss->end_frame}};
}

Json json_of(const ChangedLoss& loss) {
  const bool both = loss.change.before && loss.change.after;
  return {{"fate", to_string(loss.change.fate)},
          {"recording", loss.recording},
          {"target", loss.target},
          {"seed", loss.seed},
          {"start", loss.anchor ? Json(to_string(*loss.anchor)) : Json()},
          {"later_s", both ? Json(seconds(loss.change.later)) : Json()},
          {"longer_s", both ? Json(seconds(loss.change.longer)) : Json()},
          {"a", json_of(loss.change.before, loss.onset_before_s)},
          {"b", json_of(loss.change.after, loss.onset_after_s)},
          {"sentence", loss.text}};
}

Json json_of(const MethodChange& method) {
  Json scores, losses = Json::array(), fates;
  for (std::size_t i = 0; i < kComparedScores; ++i) {
    const auto which = static_cast<ComparedScore>(i);
    if (which != ComparedScore::losses) scores[key_of(which)] = json_of(which, method[which]);
  }
  for (const ChangedLoss& loss : method.losses) losses.push_back(json_of(loss));
  fates["a"] = method[ComparedScore::losses].before.value_or(0);
  fates["b"] = method[ComparedScore::losses].after.value_or(0);
  for (const LossFate fate : {LossFate::appeared, LossFate::gone, LossFate::moved, LossFate::kept})
    fates[std::string(to_string(fate))] = method.count(fate);
  return {{"method", method.method}, {"deterministic", method.deterministic},
          {"runs", method.runs},     {"same_runs", method.same_runs},
          {"scores", scores},        {"label_sigma_px", method.label_sigma_px},
          {"loss_counts", fates},    {"losses", losses}};
}

}  // namespace

Json changes_json(const FolderChange& change, const FolderNames& names) {
  Json groups = Json::array();
  for (const ConditionsChange& group : change.groups) {
    Json one = json_of(static_cast<const PairedConditions&>(group));
    one.erase("start");
    one["methods"] = Json::array();
    for (const MethodChange& method : group.methods) one["methods"].push_back(json_of(method));
    groups.push_back(std::move(one));
  }
  return {{"a", names.a},
          {"b", names.b},
          {"groups", groups},
          {"only_in_a", change.only_in_a},
          {"only_in_b", change.only_in_b},
          {"left_out", change.left_out}};
}

}  // namespace relock
