// What cli/gains.h tells, as text and as JSON.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "cli/gains.h"
#include "cli/json_text.h"
#include "cli/table.h"

namespace relock {
namespace {

constexpr std::size_t kNamedRecordings = 4;  // more are counted

bool is_share(CostScore score) { return score != CostScore::losses_per_minute; }

std::optional<double> shown(CostScore score, const std::optional<double>& value) {
  return value && is_share(score) ? std::optional(100 * *value) : value;
}

/// "70  +27 [+11, +40]*": the score, the gain and its interval.
std::string gain_cell(CostScore score, const Gained& gained) {
  const int decimals = is_share(score) ? 0 : 1;
  std::string text = cell(shown(score, gained.value), decimals);
  if (!gained.gain) return text;
  text += fmt::format("  {}", signed_cell(shown(score, gained.gain), decimals));
  if (const auto& i = gained.interval)
    text += fmt::format(" [{}, {}]", signed_cell(shown(score, i->low), decimals),
                        signed_cell(shown(score, i->high), decimals));
  return text + (verdict_on(score, gained.interval) != 0 ? "*" : " ");
}

void add_line(Table& table, const std::vector<std::string>& columns, const GainRow& row, CostScore score,
              std::array<Gained, kRatioScores> MemberGain::*arm, std::vector<std::string> line) {
  for (const std::string& column : columns) {
    const auto at = std::find(row.columns.begin(), row.columns.end(), column) - row.columns.begin();
    const auto member = static_cast<std::size_t>(at);
    line.push_back(member < row.gain.members.size()
                       ? gain_cell(score, (row.gain.members[member].*arm)[static_cast<std::size_t>(score)])
                       : "");
  }
  table.add(std::move(line));
}

std::string counted(const std::vector<std::string>& names, const std::string& what) {
  return names.size() > kNamedRecordings ? fmt::format("{} {}", names.size(), what)
                                         : fmt::format("{}", fmt::join(names, ", "));
}

std::string heading(const GainExperiment& e) {
  return fmt::format("Gain of combinations, gaps {}: {}, {}\n", e.gaps, counted(e.recordings, "recordings"),
                     to_string(static_cast<const PairedConditions&>(e)));
}

/// What a row does not stand on, where that is so.
std::string reservations(const GainExperiment& e) {
  std::string text;
  for (const GainRow& row : e.rows) {
    if (row.pairs < row.known_pairs)
      text += fmt::format("  {}: of {} pairs of runs the {} that all methods of the row have\n", row.tracker,
                          row.known_pairs, row.pairs);
    if (row.gain.common_targets < row.gain.targets && row.methods.size() > 1)
      text += fmt::format("  {}: of {} targets the {} that all methods of the row were asked about\n",
                          row.tracker, row.gain.targets, row.gain.common_targets);
    if (!row.deterministic)
      text +=
          fmt::format("  {} answers differently from run to run: its gains hold that, too\n", row.tracker);
  }
  if (!e.alone_is_missing.empty())
    text += fmt::format("  left out, as the tracker alone was not run: {}\n",
                        fmt::join(e.alone_is_missing, ", "));
  return text;
}

std::string footnote(CostScore score) {
  const std::string unit = is_share(score) ? fmt::format("{} in %", to_string(score))
                                           : "losses per minute of locked time: less is better";
  return fmt::format(R"(
  {}, on the frames that came in both arms; then the gain over T alone on the same frames, and
  its 95 % interval where the data tell. * the interval holds no zero. T: the tracker of the row.
)",
                     unit)
      .substr(1);
}

Json json_of(const Gained& gained) {
  return {{"value", number(gained.value)},
          {"gain", number(gained.gain)},
          {"interval", interval(gained.interval)}};
}

Json json_of(const MemberGain& member) {
  Json scores;
  for (std::size_t i = 0; i < kRatioScores; ++i) {
    std::string name(to_string(static_cast<CostScore>(i)));
    std::replace(name.begin(), name.end(), ' ', '_');
    scores[name] = {{"without", json_of(member.without[i])}, {"with", json_of(member.with[i])}};
  }
  return scores;
}

Json json_of(const GainExperiment& e, const GainRow& row, std::size_t member) {
  const MemberGain& gain = row.gain.members[member];
  Json one = json_of(static_cast<const PairedConditions&>(e));
  one.update(Json{{"tracker", row.tracker},
                  {"method", row.methods[member]},
                  {"deterministic", row.deterministic},
                  {"pairs", row.pairs},
                  {"frames", row.gain.frames},
                  {"common_frames", row.gain.common_frames},
                  {"targets", row.gain.targets},
                  {"common_targets", row.gain.common_targets},
                  {"losses", {{"without", gain.losses_without}, {"with", gain.losses_with}}},
                  {"scores", json_of(gain)}});
  return one;
}

}  // namespace

std::string gain_text(const GainExperiment& experiment, CostScore score) {
  std::vector<std::string> header{"", "gaps"};
  header.insert(header.end(), experiment.columns.begin(), experiment.columns.end());
  Table table(header);
  for (const GainRow& row : experiment.rows) {
    add_line(table, experiment.columns, row, score, &MemberGain::without, {row.tracker, "without"});
    add_line(table, experiment.columns, row, score, &MemberGain::with, {"", "with"});
  }
  return heading(experiment) + "\n" + table.text(2) + "\n" + reservations(experiment) + footnote(score);
}

std::string gain_json(const std::vector<GainExperiment>& experiments) {
  Json all = Json::array();
  for (const GainExperiment& experiment : experiments)
    for (const GainRow& row : experiment.rows)
      for (std::size_t m = 0; m < row.gain.members.size(); ++m) all.push_back(json_of(experiment, row, m));
  return json_text(all);
}

}  // namespace relock
