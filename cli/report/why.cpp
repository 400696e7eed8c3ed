#include "cli/report/why.h"

#include <algorithm>
#include <set>

#include "cli/files.h"
#include "cli/in_parallel.h"
#include "cli/report/encoded.h"

namespace relock::reports {
namespace {

/// What steps are sorted by. The last bin has no end; a step whose value is not known is in none.
struct Sorting {
  const char* key;
  const char* title;
  std::vector<double> upto;  ///< least values that are in the next bin
  std::vector<const char*> names;
  std::optional<double> (*of)(const Transition&);
};

std::optional<double> slots_of(const Transition& step) {
  return 1 + step.injected_slots + step.recorded_slots + step.skipped_slots;
}
std::optional<double> percent_of(const std::optional<double>& tenths) {
  return tenths ? std::optional(10 * *tenths) : std::nullopt;
}

const std::vector<Sorting>& sortings() {
  static const std::vector<Sorting> all{
      {"gap",
       "slots from one frame to the next",
       {1.5, 2.5, 3.5, 4.5, 8.5},
       {"1", "2", "3", "4", "5-8", "9+"},
       slots_of},
      {"blur",
       "blur on arrival, % of the target's size",
       {5, 10, 20, 40, 80},
       {"<5", "5-10", "10-20", "20-40", "40-80", "80+"},
       [](const Transition& step) { return percent_of(step.blur); }},
      {"displacement",
       "displacement between frames, % of the target's size",
       {5, 10, 20, 40, 80},
       {"<5", "5-10", "10-20", "20-40", "40-80", "80+"},
       [](const Transition& step) { return percent_of(step.displacement); }}};
  return all;
}

/// [[taken, lost, low, high], …] of each bin; steps of different moments, so that the interval is Wilson's.
Json bins_json(const std::vector<TransitionRun>& runs, const Sorting& sorting) {
  std::vector<std::size_t> taken(sorting.names.size()), lost(sorting.names.size());
  for (const TransitionRun& run : runs)
    for (const Transition& step : run.transitions)
      if (const auto value = sorting.of(step)) {
        const auto bin = static_cast<std::size_t>(
            std::upper_bound(sorting.upto.begin(), sorting.upto.end(), *value) - sorting.upto.begin());
        ++taken[bin], lost[bin] += step.lost ? 1 : 0;
      }
  Json bins = Json::array();
  for (std::size_t i = 0; i < taken.size(); ++i) {
    const Interval sure = wilson(static_cast<double>(lost[i]), static_cast<double>(taken[i]));
    bins.push_back({taken[i], lost[i], rounded(sure.low, 5), rounded(sure.high, 5)});
  }
  return bins;
}

/// The Kaplan-Meier curve at its steps: [[s, share, low, high], …], to the end of the follow-up.
Json curve_json(const std::vector<TrackingLifetime>& lifetimes) {
  std::vector<Lifetime> all;
  std::set<double> steps{0};
  for (const TrackingLifetime& lifetime : lifetimes) {
    all.push_back({lifetime.seconds, lifetime.lost});
    if (lifetime.lost) steps.insert(lifetime.seconds);
  }
  const KaplanMeier curve(all);
  steps.insert(curve.follow_up());
  Json points = Json::array();
  for (const double at : steps) {
    const auto sure = curve.survival_interval(at);
    points.push_back({rounded(at, 3), rounded(curve.survival(at), 4), sure ? rounded(sure->low, 4) : Json(),
                      sure ? rounded(sure->high, 4) : Json()});
  }
  return points;
}

/// By protocol vot a method is started again after one failed frame, which is no loss by the rules.
Json survival_json(const PooledRuns& group, const PooledMethod& method) {
  const auto held = lifetimes(method);
  if (group.showing.protocol == Protocol::vot || held.empty()) return {};
  return {{"words", method.method + " " + sentence(tracking_survival(held))},
          {"starts", held.size()},
          {"curve", curve_json(held)}};
}

/// What takes longest of all: the fits of a bootstrap.
Json attribution_json(const PooledRuns& group, const PooledMethod& method) {
  Json sentences = Json::array();
  if (method.yardstick) return sentences;
  const Attribution found =
      attribute(transitions(method), group.gaps == "none" ? Gaps::recorded : Gaps::injected);
  sentences.push_back(sentence(found));
  for (const Effect& effect : found.effects) sentences.push_back(sentence(effect));
  return sentences;
}

Json method_json(const PooledRuns& group, const PooledMethod& method) {
  const auto runs = transitions(method);
  Json json{{"method", method.method}, {"yardstick", method.yardstick}};
  for (const Sorting& sorting : sortings()) json[sorting.key] = bins_json(runs, sorting);
  json["survival"] = survival_json(group, method);
  json["attribution"] = attribution_json(group, method);
  return json;
}

}  // namespace

Json why_json(const std::vector<PooledRuns>& groups, int jobs) {
  Json axes = Json::array(), all = Json::array();
  for (const Sorting& sorting : sortings())
    axes.push_back({{"key", sorting.key}, {"title", sorting.title}, {"bins", sorting.names}});
  for (const PooledRuns& group : groups) {
    std::vector<Json> methods(group.methods.size());
    in_parallel(methods.size(), jobs,
                [&] { return [&](std::size_t i) { methods[i] = method_json(group, group.methods[i]); }; });
    all.push_back({{"heading", heading(group)}, {"methods", methods}});
  }
  return {{"axes", axes}, {"groups", all}};
}

std::optional<std::string> map_picture(const std::filesystem::path& results) {
  if (!std::filesystem::exists(results / "map.json") || !std::filesystem::exists(results / "map.png"))
    return {};
  const std::string png = read_file(results / "map.png");
  const std::vector<std::uint8_t> bytes(png.begin(), png.end());
  return "data:image/png;base64," + base64(bytes);
}

}  // namespace relock::reports
