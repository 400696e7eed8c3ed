#include "cli/paired.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "cli/comparison.h"
#include "cli/json_text.h"
#include "cli/table.h"

namespace relock {
namespace {

/// What the gaps cost the method `of`, over all its pairs.
GapCost cost_of(const std::vector<Arms>& all, const std::string& of, const Gate& gate) {
  std::vector<EquallyLong> kept;
  for (const Arms& arms : all)
    if (arms.with.record.method == of) kept.push_back(equally_long(arms));
  std::vector<Pair> pairs;
  for (const EquallyLong& pair : kept) pairs.push_back({pair.recording, pair.without, pair.with});
  return cost_of_gaps(pairs, gate);
}

GapExperiment experiment_on(const std::vector<Arms>& all, const std::optional<std::string>& gate) {
  GapExperiment experiment{paired_conditions(all, gate), {}};
  std::vector<const RunRecord*> methods;
  for (const Arms& arms : all) {
    const RunRecord& record = arms.with.record;
    const auto same = [&](const RunRecord* other) { return other->method == record.method; };
    if (std::none_of(methods.begin(), methods.end(), same)) methods.push_back(&record);
  }
  std::stable_partition(methods.begin(), methods.end(), [](const RunRecord* r) { return !r->yardstick; });
  for (const RunRecord* method : methods)
    experiment.methods.push_back({method->method, method->yardstick, method->deterministic,
                                  cost_of(all, method->method, experiment.gate)});
  return experiment;
}

// Text

std::string interval_text(const std::optional<Interval>& interval, int decimals) {
  if (!interval) return "n/a";
  return fmt::format("[{}, {}]", signed_cell(interval->low, decimals), signed_cell(interval->high, decimals));
}

std::string mark(int verdict) { return verdict < 0 ? "worse" : verdict > 0 ? "better" : ""; }

void add_score(Table& table, CostScore which, const PairedScore& score, int decimals) {
  table.add({fmt::format("  {}", to_string(which)), cell(score.without, decimals), cell(score.with, decimals),
             signed_cell(score.difference, decimals), interval_text(score.interval, decimals),
             mark(verdict_on(which, score.interval))});
}

/// An error below the accuracy of the labels says nothing, and neither does its difference.
void add_error(Table& table, const GapCost& cost) {
  const PairedScore& score = cost[CostScore::error_px];
  const double least = 2 * cost.label_sigma_px;
  const auto below = [&](const std::optional<double>& px) { return px && *px < least; };
  if (!below(score.without) && !below(score.with)) return add_score(table, CostScore::error_px, score, 2);
  const auto px_cell = [&](const std::optional<double>& px) {
    return below(px) ? fmt::format("<{:.2f}", least) : cell(px, 2);
  };
  table.add({fmt::format("  {}", to_string(CostScore::error_px)), px_cell(score.without), px_cell(score.with),
             "n/a", "n/a", ""});
}

void add_method(Table& table, const GapExperiment::MethodCost& method) {
  const GapCost& cost = method.cost;
  table.add({method.method, "", "", "", "", ""});
  add_score(table, CostScore::recognition, cost[CostScore::recognition], 3);
  add_score(table, CostScore::locked_share, cost[CostScore::locked_share], 3);
  add_score(table, CostScore::availability, cost[CostScore::availability], 3);
  table.add({"  available, all frames", cell(cost.recorded_availability_without, 3),
             cell(cost.recorded_availability_with, 3), "", "", ""});
  table.add({"  losses", std::to_string(cost.losses_without), std::to_string(cost.losses_with), "", "", ""});
  add_score(table, CostScore::losses_per_minute, cost[CostScore::losses_per_minute], 1);
  add_error(table, cost);
}

/// Whether nothing differs between the arms; so it is with yardsticks that do not look at pictures.
bool same_in_both(const GapCost& cost) {
  return cost.losses_with == cost.losses_without &&
         std::all_of(cost.scores.begin(), cost.scores.end(),
                     [](const PairedScore& s) { return s.difference.value_or(0) == 0; });
}

std::string heading(const GapExperiment& e) {
  return fmt::format("Cost of the gaps {}: {}, {}\n", e.gaps, fmt::join(e.recordings, ", "),
                     to_string(static_cast<const PairedConditions&>(e)));
}

/// Then frames come that a busy method never looks at.
bool in_real_time(const GapExperiment& e) { return !e.showing.real_time.empty(); }

/// How many frames the scores stand on; for each method where resets cut the pairs differently.
std::string frames_text(const GapExperiment& e) {
  const auto text = [&](const GapCost& cost) {
    return fmt::format("{} of {} recorded frames {} in both arms", cost.common_frames, cost.frames,
                       in_real_time(e) ? "were looked at" : "came");
  };
  const auto cut = [](const GapExperiment::MethodCost& m) { return m.cost.ended_at_reset > 0; };
  if (std::none_of(e.methods.begin(), e.methods.end(), cut) && !e.methods.empty())
    return fmt::format("  {}\n", text(e.methods.front().cost));
  std::string all;
  for (const auto& m : e.methods)
    all += fmt::format("  {}: {}{}\n", m.method, text(m.cost),
                       cut(m) ? fmt::format(" before the first reset ({} of {} pairs have one)",
                                            m.cost.ended_at_reset, m.cost.pairs)
                              : "");
  return all;
}

std::string footnote(const std::vector<GapExperiment>& experiments) {
  const bool real_time = std::any_of(experiments.begin(), experiments.end(), in_real_time);
  return fmt::format(R"(
  Differences are with - without, on the frames that {} in both arms; worse, better: the interval holds no zero.
  error px: medians over Hits of both arms on the same frame, and the median of their differences there.
  available, all frames: on every recorded frame, so that it shows how old answers grow over the gaps.
)",
                     real_time ? "came (in real time: were looked at)" : "came")
      .substr(1);
}

// JSON

Json json_of(const PairedScore& score) {
  return {{"without", number(score.without)},
          {"with", number(score.with)},
          {"difference", number(score.difference)},
          {"interval", interval(score.interval)}};
}

Json json_of(const GapExperiment& e, const GapExperiment::MethodCost& m) {
  Json scores;
  for (std::size_t i = 0; i < kCostScores; ++i) {
    std::string name(to_string(static_cast<CostScore>(i)));
    std::replace(name.begin(), name.end(), ' ', '_');
    scores[name] = json_of(m.cost.scores[i]);
  }
  Json one = json_of(static_cast<const PairedConditions&>(e));
  one.update(Json{{"method", m.method},
                  {"yardstick", m.yardstick},
                  {"deterministic", m.deterministic},
                  {"pairs", m.cost.pairs},
                  {"ended_at_reset", m.cost.ended_at_reset},
                  {"frames", m.cost.frames},
                  {"common_frames", m.cost.common_frames},
                  {"losses", {{"without", m.cost.losses_without}, {"with", m.cost.losses_with}}},
                  {"scores", scores},
                  {"recorded_availability",
                   {{"without", number(m.cost.recorded_availability_without)},
                    {"with", number(m.cost.recorded_availability_with)}}},
                  {"label_sigma_px", m.cost.label_sigma_px}});
  return one;
}

}  // namespace

std::vector<GapExperiment> gap_experiments(const std::vector<StoredComparison>& comparisons,
                                           const std::optional<std::string>& gate) {
  std::vector<GapExperiment> experiments;
  for (const std::vector<Arms>& arms : arms_by_pattern(comparisons))
    experiments.push_back(experiment_on(arms, gate));
  return experiments;
}

std::string cost_text(const GapExperiment& experiment) {
  Table table({"", "without", "with", "difference", "95 % interval", ""});
  std::vector<std::string> same;
  for (const auto& method : experiment.methods) {
    if (method.yardstick && same_in_both(method.cost)) {
      same.push_back(method.method);
    } else {
      add_method(table, method);
    }
  }
  std::string text = heading(experiment) + frames_text(experiment) + "\n" + table.text(2);
  if (!same.empty()) text += fmt::format("  yardsticks without any difference: {}\n", fmt::join(same, ", "));
  for (const auto& method : experiment.methods)
    if (!method.deterministic)
      text += fmt::format("  {} answers differently from run to run: its differences hold that, too\n",
                          method.method);
  return text;
}

std::string cost_json(const std::vector<GapExperiment>& experiments) {
  Json all = Json::array();
  for (const GapExperiment& experiment : experiments)
    for (const auto& method : experiment.methods) all.push_back(json_of(experiment, method));
  return json_text(all);
}

void print_cost_of_gaps(const std::vector<StoredComparison>& comparisons,
                        const std::optional<std::string>& gate) {
  const auto experiments = gap_experiments(comparisons, gate);
  for (const GapExperiment& experiment : experiments) fmt::print("{}\n", cost_text(experiment));
  for (const std::string& sentence : without_a_pair(comparisons)) fmt::print("  left out: {}\n", sentence);
  fmt::print("{}", footnote(experiments));
}

}  // namespace relock
