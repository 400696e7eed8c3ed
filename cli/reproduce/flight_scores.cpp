#include "cli/reproduce/flight_scores.h"

#include <fmt/format.h>

#include <algorithm>

#include "eval/statistics/ratio.h"

namespace relock::reproduction {
namespace {

/// `part` of `whole` in each frame, flight by flight.
template <class Part, class Whole>
std::vector<RatioSeries> series(const MethodPool& pool, const Part& part, const Whole& whole) {
  std::vector<RatioSeries> all;
  for (const auto& [recording, frames] : pool.frames) {
    RatioSeries& one = all.emplace_back();
    for (const Contribution& frame : frames)
      one.part.push_back(part(frame)), one.whole.push_back(whole(frame));
  }
  return all;
}

Share share_of(const std::vector<RatioSeries>& flights) {
  double part = 0, whole = 0;
  for (const RatioSeries& flight : flights) {
    for (const double value : flight.part) part += value;
    for (const double value : flight.whole) whole += value;
  }
  if (whole == 0) return {};
  return {part / whole, ratio_interval(flights)};
}

FlightScores scores_of_pool(const MethodPool& pool, const JudgedMethod& judged) {
  const Scores& scores = judged.scores;
  FlightScores one{.method = pool.method};
  for (const auto& [recording, frames] : pool.frames) one.frames += frames.size();
  one.targets = pool.targets() / pool.frames.size();
  const auto hits = [](const Contribution& frame) { return static_cast<double>(frame.hits); };
  const auto targets = static_cast<double>(one.targets);
  one.recognition = {scores.recognition, judged.shares[0]};
  one.of_all_frames = share_of(series(pool, hits, [&](const Contribution&) { return targets; }));
  one.any = share_of(series(
      pool, [](const Contribution& frame) { return frame.hits > 0 ? 1.0 : 0.0; },
      [](const Contribution&) { return 1.0; }));
  one.precision = {scores.precision, judged.shares[1]};
  const auto count = [&](Verdict verdict) { return scores.verdicts[static_cast<std::size_t>(verdict)]; };
  one.wrong_codes = count(Verdict::WrongId);
  one.false_sightings = count(Verdict::Stray) + count(Verdict::FalseAlarm) + scores.spurious;
  return one;
}

std::vector<ScoreTable> tables_of(const std::vector<ScoredComparison>& flights, Grouping grouping) {
  ScorePool pool(grouping, flights.size());
  for (const ScoredComparison& flight : flights) pool.add(flight);
  return std::move(pool).tables();
}

void add_blur_bins(const std::vector<ScoredComparison>& flights, std::vector<FlightScores>& all) {
  for (const ScoreTable& bin : tables_of(flights, Grouping::blur)) {
    const auto judged_bin = judged(bin);
    for (std::size_t m = 0; m < bin.methods.size(); ++m) {
      const auto at = std::ranges::find(all, bin.methods[m].method, &FlightScores::method);
      const Contribution& sum = bin.methods[m].tally.sum;
      if (at == all.end() || sum.could_hit == 0) continue;
      const HitCount hits{static_cast<std::size_t>(sum.could_hit), static_cast<std::size_t>(sum.hits)};
      at->by_blur.push_back({bin.group, hits, {judged_bin[m].scores.recognition, judged_bin[m].shares[0]}});
    }
  }
}

enum LaneKind : std::size_t { kDetected, kNotDetected, kNotVisible, kGap };

LaneKind kind_of(const ScoredComparison& flight, std::size_t run, std::size_t frame) {
  bool visible = false;
  for (std::size_t t = 0; t < flight.stored.recording.targets.size(); ++t) {
    if (!flight.stored.runs[run].trajectory.judged_from[t]) continue;
    const Verdict verdict = flight.evaluations[run].targets[t].judgements[frame].verdict;
    if (verdict == Verdict::Hit) return kDetected;
    visible |= scored(verdict);
  }
  return visible ? kNotDetected : kNotVisible;
}

}  // namespace

std::vector<FlightScores> flight_scores(const std::vector<ScoredComparison>& flights) {
  std::vector<FlightScores> all;
  for (const ScoreTable& table : tables_of(flights, Grouping::none)) {
    const auto methods = judged(table);
    for (std::size_t m = 0; m < methods.size(); ++m)
      if (!table.methods[m].yardstick) all.push_back(scores_of_pool(table.methods[m], methods[m]));
  }
  add_blur_bins(flights, all);
  return all;
}

const FlightScores* find(const std::vector<FlightScores>& scores, std::string_view method) {
  const auto at = std::ranges::find(scores, method, &FlightScores::method);
  return at == scores.end() ? nullptr : &*at;
}

bool above_100ms(Duration interval, Duration period) {
  return static_cast<double>(slots(interval, period)) * seconds(period) > 0.1 + 1e-6;
}

GapStatistics gap_statistics(const std::vector<Time>& captured, Duration period) {
  GapStatistics gaps{.frames = captured.size(), .length_s = seconds(captured.back() - captured.front())};
  Duration longest{0}, shortest = captured.back() - captured.front();
  double above = 0;
  for (std::size_t i = 1; i < captured.size(); ++i) {
    const Duration interval = captured[i] - captured[i - 1];
    above += above_100ms(interval, period) ? 1 : 0;
    longest = std::max(longest, interval), shortest = std::min(shortest, interval);
  }
  const double intervals = static_cast<double>(captured.size()) - 1;
  gaps.above_100ms_per_1000 = 1000 * above / intervals;
  gaps.longest_s = seconds(longest), gaps.shortest_s = seconds(shortest);
  gaps.mean_s = gaps.length_s / intervals;
  return gaps;
}

const std::vector<std::string>& lane_kinds() {
  static const std::vector<std::string> kinds{"detected", "not detected", "target not visible",
                                              "no frame for more than 0.1 s"};
  return kinds;
}

std::optional<PlotLane> lane_of(const ScoredComparison& flight, const std::string& method) {
  const auto& runs = flight.stored.runs;
  const auto run =
      std::ranges::find_if(runs, [&](const StoredRun& stored) { return stored.record.method == method; });
  if (run == runs.end()) return {};
  const auto index = static_cast<std::size_t>(run - runs.begin());
  const Recording& recording = flight.stored.recording;
  const auto at = [&](std::size_t frame) {
    return seconds(recording.captured[frame] - recording.captured[0]);
  };
  PlotLane lane{method, {}};
  const auto add = [&](double from, double to, std::size_t kind) {
    if (!lane.stretches.empty() && lane.stretches.back().kind == kind)
      lane.stretches.back().to = to;
    else
      lane.stretches.push_back({from, to, kind});
  };
  for (std::size_t frame = 0; frame < recording.frames(); ++frame) {
    const std::size_t kind = kind_of(flight, index, frame);
    const double shown_until = at(frame) + seconds(recording.period);
    const bool last = frame + 1 == recording.frames();
    const bool gap =
        !last && above_100ms(recording.captured[frame + 1] - recording.captured[frame], recording.period);
    add(at(frame), last || gap ? shown_until : at(frame + 1), kind);
    if (gap) add(shown_until, at(frame + 1), kGap);
  }
  return lane;
}

std::string percent_cell(const Share& share) {
  if (!share.value) return "n/a";
  const std::string value = fmt::format("{:.1f}", 100 * *share.value);
  if (!share.interval) return value;
  return fmt::format("{} [{:.1f}, {:.1f}]", value, 100 * share.interval->low, 100 * share.interval->high);
}

Json json_of(const Share& share) {
  return {{"value", number(share.value)}, {"interval", interval(share.interval)}};
}

Json json_of(const FlightScores& scores) {
  Json bins = Json::array();
  for (const auto& bin : scores.by_blur)
    bins.push_back({{"blur_px", bin.name},
                    {"could_hit", bin.hits.could_hit},
                    {"hits", bin.hits.hits},
                    {"recognition", json_of(bin.recognition)}});
  return {{"method", scores.method},
          {"frames", scores.frames},
          {"targets", scores.targets},
          {"recognition", json_of(scores.recognition)},
          {"hits_of_all_frames", json_of(scores.of_all_frames)},
          {"frames_with_a_hit", json_of(scores.any)},
          {"precision", json_of(scores.precision)},
          {"wrong_codes", scores.wrong_codes},
          {"false_sightings", scores.false_sightings},
          {"by_blur", bins}};
}

Json json_of(const GapStatistics& gaps) {
  return {{"frames", gaps.frames},
          {"length_s", gaps.length_s},
          {"intervals_above_100ms_per_1000", gaps.above_100ms_per_1000},
          {"longest_s", gaps.longest_s},
          {"shortest_s", gaps.shortest_s},
          {"mean_s", gaps.mean_s}};
}

}  // namespace relock::reproduction
