#include "cli/report/answers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "cli/report/encoded.h"
#include "cli/scores/print.h"
#include "eval/loss_text.h"

namespace relock::reports {
namespace {

enum : std::size_t { kRecognition = 0, kAvailability = 2 };  // of share_scores()

/// Methods by availability, the best first; then yardsticks likewise.
std::vector<std::size_t> in_order(const JudgedTable& judged) {
  std::vector<std::size_t> order(judged.methods.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const bool ya = judged.table.methods[a].yardstick, yb = judged.table.methods[b].yardstick;
    if (ya != yb) return yb;
    return judged.methods[a].scores.availability.value_or(-1) >
           judged.methods[b].scores.availability.value_or(-1);
  });
  return order;
}

Json share_json(const JudgedMethod& method, std::size_t which) {
  return {{"value", rounded(method.scores.*share_scores()[which].value, 4)},
          {"interval", interval(method.shares[which])},
          {"standing", to_string(method.standings[which])}};
}

Json method_json(const JudgedTable& judged, std::size_t i) {
  const JudgedMethod& m = judged.methods[i];
  const Scores& s = m.scores;
  Json kinds;
  for (std::size_t k = 0; k < kLossKinds; ++k)
    kinds[std::string(to_string(static_cast<LossKind>(k)))] = s.losses_by_kind[k];
  return {{"method", judged.table.methods[i].method},
          {"yardstick", judged.table.methods[i].yardstick},
          {"availability", share_json(m, kAvailability)},
          {"of_ceiling", rounded(s.availability_of_ceiling, 4)},
          {"recognition", share_json(m, kRecognition)},
          {"losses", s.losses},
          {"kinds", kinds},
          {"per_minute", rounded(s.losses_per_minute, 2)},
          {"per_minute_interval", interval(m.losses_per_minute)},
          {"recovered", s.recovery.recovered},
          {"recover_s", rounded(s.recovery.median_s, 3)},
          {"recover_interval", interval(s.recovery.median_s_interval)},
          {"watched_s", rounded(s.recovery.follow_up_s, 3)},
          {"error_px", rounded(s.localization.median_px, 3)},
          {"error_interval", interval(m.median_px)},
          {"error_percent", rounded(s.localization.median_percent, 2)},
          {"sigma_px", rounded(s.localization.label_sigma_px, 3)},
          {"wall_ms", m.cost ? rounded(m.cost->wall.median_ms, 3) : Json()},
          {"wall_p95_ms", m.cost ? rounded(m.cost->wall.p95_ms, 3) : Json()}};
}

Json table_json(const JudgedTable& judged) {
  Json methods = Json::array(), notes = Json::array();
  for (const std::size_t i : in_order(judged)) {
    methods.push_back(method_json(judged, i));
    for (const std::string& remark : remarks(judged, i)) notes.push_back(remark);
  }
  return {{"methods", methods}, {"remarks", notes}};
}

std::string percent(double share) { return fmt::format("{:.0f} %", 100 * share); }

std::string percent(const std::optional<Interval>& of) {
  return of ? fmt::format(" (95 % interval {:.0f} to {:.0f} %)", 100 * of->low, 100 * of->high) : "";
}

/// "csrt and kcf", "csrt, kcf and 3 others".
std::string named(const std::vector<std::string>& names) {
  if (names.size() <= 4) return joined(names);
  return joined({names[0], names[1], names[2], fmt::format("{} others", names.size() - 3)});
}

/// A method that was asked about some targets only is not quite comparable.
std::string name_of(const JudgedTable& judged, std::size_t i) {
  const MethodPool& method = judged.table.methods[i];
  if (method.targets() == judged.table.targets()) return method.method;
  return fmt::format("{} (asked about {} of {} targets)", method.method, method.targets(),
                     judged.table.targets());
}

std::string whose_was_longest(const JudgedTable& judged) {
  std::optional<std::size_t> best;
  std::vector<std::string> tied, untold;
  std::size_t methods = 0;
  for (const std::size_t i : in_order(judged)) {
    const std::string name = name_of(judged, i);
    if (judged.table.methods[i].yardstick) continue;
    ++methods;
    const Standing standing = judged.methods[i].standings[kAvailability];
    if (standing == Standing::best) best = i;
    if (standing == Standing::tied) tied.push_back(name);
    if (standing == Standing::untold) untold.push_back(name);
  }
  if (!best) return methods == 0 ? "Only yardsticks were run." : "";
  const JudgedMethod& m = judged.methods[*best];
  std::string text = fmt::format(
      "{}{} knew where the target was, by an answer no more than 0.1 s old, for {} of the time it could be "
      "seen{}",
      methods > 1 ? fmt::format("Of {} methods, ", methods) : "", name_of(judged, *best),
      percent(*m.scores.availability), percent(m.shares[kAvailability]));
  text += methods > 1 ? ", the longest" : "";
  if (!tied.empty()) text += fmt::format("; {} {} as good", named(tied), tied.size() == 1 ? "is" : "are");
  if (!untold.empty()) text += fmt::format("; the data are too few to tell it from {}", named(untold));
  return text + ".";
}

std::string what_was_lost(const JudgedTable& judged) {
  std::size_t losses = 0, recovered = 0, silent = 0;
  std::string most;
  std::size_t most_losses = 0, methods = 0;
  for (std::size_t i = 0; i < judged.methods.size(); ++i) {
    if (judged.table.methods[i].yardstick) continue;
    ++methods;
    const Scores& s = judged.methods[i].scores;
    losses += s.losses, recovered += s.recovery.recovered;
    silent += s.losses - s.losses_by_kind[static_cast<std::size_t>(LossKind::Declared)];
    if (s.losses > most_losses) most_losses = s.losses, most = judged.table.methods[i].method;
  }
  if (methods == 0) return {};
  if (losses == 0) return methods == 1 ? "It never lost it." : "None of them ever lost it.";
  std::string text =
      fmt::format("The target was lost {}", losses == 1 ? "once" : fmt::format("{} times", losses));
  if (methods > 1)
    text += losses == most_losses ? " by " + most : fmt::format(", most often ({}) by {}", most_losses, most);
  text += silent == 0        ? ", and every time it was said that nothing is there"
          : silent == losses ? ", each time without a word: a wrong place was given"
                             : fmt::format(", {} of them without a word: a wrong place was given", silent);
  text += recovered == 0 ? "; it was never found again by the method itself."
                         : fmt::format("; {} ended with the method finding it again by itself.",
                                       recovered == losses ? std::string("all") : std::to_string(recovered));
  return text;
}

bool can_be_judged(const JudgedTable& judged) {
  return std::any_of(judged.methods.begin(), judged.methods.end(),
                     [](const JudgedMethod& method) { return method.scores.recognition.has_value(); });
}

/// How hard it was: a box that never moves.
std::string beside_the_yardstick(const JudgedTable& judged) {
  for (std::size_t i = 0; i < judged.methods.size(); ++i)
    if (judged.table.methods[i].yardstick && judged.table.methods[i].method == "still")
      if (const auto& share = judged.methods[i].scores.availability)
        return fmt::format(
            "How hard was it? A box that never moves would have been right for {} of the time.",
            percent(*share));
  return {};
}

}  // namespace

std::vector<std::string> in_words(const JudgedTable& pooled) {
  if (!can_be_judged(pooled))
    return {"Whether methods had the target is not known: it was labelled too seldom.",
            "The timelines tell who said a place at all, and whether methods agree."};
  std::vector<std::string> all;
  for (std::string sentence :
       {whose_was_longest(pooled), what_was_lost(pooled), beside_the_yardstick(pooled)})
    if (!sentence.empty()) all.push_back(std::move(sentence));
  return all;
}

Json answers_json(const std::vector<JudgedTable>& tables) {
  Json all = Json::array();
  for (const JudgedTable& judged : tables) {
    if (judged.table.grouping != Grouping::none) continue;
    Json json = table_json(judged);
    json["heading"] = heading(judged.table);
    json["words"] = in_words(judged);
    json["targets"] = Json::array();
    for (const JudgedTable& single : tables)
      if (single.table.grouping == Grouping::target && single.table.conditions == judged.table.conditions &&
          judged.table.targets() > 1) {
        json["targets"].push_back(table_json(single));
        json["targets"].back()["target"] = single.table.group;
      }
    all.push_back(std::move(json));
  }
  return all;
}

}  // namespace relock::reports
