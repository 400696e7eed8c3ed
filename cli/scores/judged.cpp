#include "cli/scores/judged.h"

#include <algorithm>
#include <numeric>

#include "eval/statistics/ratio.h"

namespace relock {
namespace {

double count(std::int64_t n) { return static_cast<double>(n); }

/// What each frame of a recording adds to one score.
RatioSeries series_of(const ShareScore& score, const std::vector<Contribution>& frames) {
  RatioSeries series;
  for (const Contribution& frame : frames) {
    series.part.push_back(score.part(frame));
    series.whole.push_back(score.whole(frame));
  }
  return series;
}

std::vector<RatioSeries> series_of(const ShareScore& score, const MethodPool& method) {
  std::vector<RatioSeries> all;
  for (const auto& [recording, frames] : method.frames) all.push_back(series_of(score, frames));
  return all;
}

/// Targets, and which frames were shown.
std::set<std::pair<std::string, std::string>> scored_on(const std::string& recording,
                                                        const MethodPool& method) {
  std::set<std::pair<std::string, std::string>> all;
  for (const auto& [of, target, shown] : method.scored_on)
    if (of == recording) all.insert({target, shown});
  return all;
}

/// Of the recordings on which both were scored on the same targets and were shown the same frames.
struct Pair {
  std::vector<RatioSeries> a, b;
};
Pair paired(const ShareScore& score, const MethodPool& a, const MethodPool& b) {
  Pair both;
  for (const auto& [recording, frames] : a.frames) {
    const auto other = b.frames.find(recording);
    if (other == b.frames.end() || other->second.size() != frames.size()) continue;
    if (scored_on(recording, a) != scored_on(recording, b)) continue;
    both.a.push_back(series_of(score, frames));
    both.b.push_back(series_of(score, other->second));
  }
  return both;
}

std::optional<Interval> losses_per_minute(const Scores& scores) {
  if (scores.locked_s <= 0) return {};
  return poisson_rate(scores.losses, scores.locked_s / 60);
}

std::optional<Interval> median_error(const MethodPool& method) {
  std::vector<std::vector<FramedValue>> errors;
  for (const auto& [recording, of_it] : method.errors_px) errors.push_back(of_it);
  return quantile_interval(errors, 0.5);
}

/// The best method by a score, the first of several; nothing where none has it.
std::optional<std::size_t> best_of(const ScoreTable& table, const std::vector<JudgedMethod>& judged,
                                   const ShareScore& score) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < judged.size(); ++i) {
    const auto& value = judged[i].scores.*score.value;
    if (table.methods[i].yardstick || !value) continue;
    if (!best || *value > *(judged[*best].scores.*score.value)) best = i;
  }
  return best;
}

double share_of(const RatioSeries& series) {
  return std::accumulate(series.part.begin(), series.part.end(), 0.0) /
         std::accumulate(series.whole.begin(), series.whole.end(), 0.0);
}

/// On ten recordings and more, a method that is better on every one is better: by chance that happens once in 500
/// times. Differences that are all alike have no scatter, and so no interval.
bool better_on_all(const Pair& both) {
  for (std::size_t i = 0; i < both.a.size(); ++i)
    if (!(share_of(both.a[i]) > share_of(both.b[i]))) return false;
  return both.a.size() >= kRecordingsToResample;
}

Standing standing_to(const ShareScore& score, const MethodPool& best, const MethodPool& method) {
  const Pair both = paired(score, best, method);
  if (const auto difference = difference_interval(both.a, both.b))
    return difference->low > 0 ? Standing::worse : difference->high >= 0 ? Standing::tied : Standing::untold;
  if (better_on_all(both)) return Standing::worse;
  return Standing::untold;
}

void rank(const ScoreTable& table, std::size_t which, std::vector<JudgedMethod>& judged) {
  const ShareScore& score = share_scores()[which];
  const auto best = best_of(table, judged, score);
  if (!best) return;
  for (std::size_t i = 0; i < judged.size(); ++i) {
    if (table.methods[i].yardstick || !(judged[i].scores.*score.value)) continue;
    Standing& standing = judged[i].standings[which];
    if (i == *best)
      standing = Standing::best;
    else if (judged[i].scores.*score.value == judged[*best].scores.*score.value)
      standing = Standing::tied;
    else
      standing = standing_to(score, table.methods[*best], table.methods[i]);
  }
}

}  // namespace

const std::array<ShareScore, kShareScores>& share_scores() {
  using C = const Contribution&;
  static const std::array<ShareScore, kShareScores> all{{
      {"recognition", &Scores::recognition, [](C c) { return count(c.hits); },
       [](C c) { return count(c.could_hit); }},
      {"precision", &Scores::precision, [](C c) { return count(c.hits); }, [](C c) { return count(c.said); }},
      {"availability", &Scores::availability, [](C c) { return seconds(c.fresh); },
       [](C c) { return seconds(c.visible); }},
      {"availability_of_ceiling", &Scores::availability_of_ceiling, [](C c) { return seconds(c.fresh); },
       [](C c) { return seconds(c.fresh_ceiling); }},
      {"locked_share", &Scores::locked_share, [](C c) { return seconds(c.locked); },
       [](C c) { return seconds(c.visible); }},
      {"locked_share_of_ceiling", &Scores::locked_share_of_ceiling, [](C c) { return seconds(c.locked); },
       [](C c) { return seconds(c.locked_ceiling); }},
  }};
  return all;
}

std::string_view to_string(Standing standing) {
  constexpr std::string_view names[] = {"", "best", "tied", "worse", "untold"};
  return names[static_cast<std::size_t>(standing)];
}

std::optional<Cost> cost_of(const std::vector<FrameCost>& costs) {
  if (costs.empty()) return {};
  const auto spread = [&](Duration FrameCost::*time) -> Spread {
    std::vector<double> ms;
    for (const FrameCost& cost : costs) ms.push_back(1e3 * seconds(cost.*time));
    return {percentile(ms, 0.5), percentile(ms, 0.95), percentile(ms, 1)};
  };
  Cost all{costs.size(), spread(&FrameCost::wall), spread(&FrameCost::cpu), 0};
  for (const FrameCost& cost : costs) all.peak_bytes = std::max(all.peak_bytes, cost.peak_bytes);
  return all;
}

std::vector<JudgedMethod> judged(const ScoreTable& table) {
  std::vector<JudgedMethod> all;
  for (const MethodPool& method : table.methods) {
    JudgedMethod one;
    one.scores = scores_of(method.tally);
    one.common = localize(method.common, 0);
    for (std::size_t i = 0; i < kShareScores; ++i)
      one.shares[i] = ratio_interval(series_of(share_scores()[i], method));
    one.losses_per_minute = losses_per_minute(one.scores);
    one.median_px = median_error(method);
    one.cost = cost_of(method.costs);
    all.push_back(std::move(one));
  }
  for (std::size_t i = 0; i < kShareScores; ++i) rank(table, i, all);
  return all;
}

}  // namespace relock
