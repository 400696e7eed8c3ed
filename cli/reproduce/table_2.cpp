// Table 2 of the paper: the ring between two square markers, on four flights.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/reproduce/flight_experiments.h"
#include "cli/reproduce/flight_runs.h"
#include "cli/reproduce/flights.h"

namespace relock::reproduction {
namespace {

const std::string kSquare = "aruco", kAprilTag = "apriltag";
constexpr std::int64_t kQuickFrames = 120;

const paper::RecordedTest& test_of(const Settings& settings, std::size_t flight) {
  return paper::recorded_tests()[settings.quick ? 1 : flight];
}

/// What each method made of each test, and of all together.
struct Scored {
  std::vector<std::vector<FlightScores>> tests;
  std::vector<FlightScores> all;
  std::vector<std::vector<FlightScores>> apriltags;
};

std::vector<std::vector<FlightScores>> one_by_one(const std::vector<ScoredComparison>& flights) {
  std::vector<std::vector<FlightScores>> all;
  for (const ScoredComparison& flight : flights) all.push_back(flight_scores({flight}));
  return all;
}

std::string recognition_cell(const std::vector<FlightScores>& scores, const std::string& method) {
  const FlightScores* found = find(scores, method);
  return found ? percent_cell(found->recognition) : "not run";
}

Table recognition_table(const Settings& settings, const Scored& scored) {
  Table table({"test", "frames", "code", "ARTag, paper %", kSquare + " %", "ring, paper %", kRing + " %"});
  std::size_t frames = 0;
  for (std::size_t i = 0; i < scored.tests.size(); ++i) {
    const paper::RecordedTest& test = test_of(settings, i);
    const std::size_t flown = scored.tests[i].front().frames;
    frames += flown;
    table.add({fmt::format("{}", test.number), fmt::format("{}", flown), std::string(test.code),
               fmt::format("{:.1f}", test.artag_percent), recognition_cell(scored.tests[i], kSquare),
               fmt::format("{:.1f}", test.ring_percent), recognition_cell(scored.tests[i], kRing)});
  }
  if (scored.tests.size() > 1)
    table.add({"all", fmt::format("{}", frames), "", "", recognition_cell(scored.all, kSquare), "",
               recognition_cell(scored.all, kRing)});
  return table;
}

void add_frames_rows(Table& table, const std::string& test, const std::vector<FlightScores>& methods) {
  for (const FlightScores& scores : methods)
    table.add({test, scores.method, percent_cell(scores.recognition), percent_cell(scores.of_all_frames),
               percent_cell(scores.any), fmt::format("{}", scores.wrong_codes),
               fmt::format("{}", scores.false_sightings), percent_cell(scores.precision)});
}

Table frames_table(const Settings& settings, const Scored& scored) {
  Table table({"test", "method", "visible %", "all frames %", "one or more %", "wrong codes", "false",
               "precision %"});
  for (std::size_t i = 0; i < scored.tests.size(); ++i) {
    const std::string test = fmt::format("{}", test_of(settings, i).number);
    add_frames_rows(table, test, scored.tests[i]);
    if (i < scored.apriltags.size()) add_frames_rows(table, test, scored.apriltags[i]);
  }
  return table;
}

Table gaps_table(const Settings& settings, const std::vector<ScoredComparison>& tests) {
  Table table({"test", "frames", "s", "over 0.1 s, of 1000", "longest s", "shortest s", "frames a second"});
  for (std::size_t i = 0; i < tests.size(); ++i) {
    const Recording& recording = tests[i].stored.recording;
    const GapStatistics gaps = gap_statistics(recording.captured, recording.period);
    table.add({fmt::format("{}", test_of(settings, i).number), fmt::format("{}", gaps.frames),
               fmt::format("{:.1f}", gaps.length_s), fmt::format("{:.0f}", gaps.above_100ms_per_1000),
               fmt::format("{:.3f}", gaps.longest_s), fmt::format("{:.3f}", gaps.shortest_s),
               fmt::format("{:.1f}", 1 / gaps.mean_s)});
  }
  table.add({"paper", "1000", "120", "50", "0.14", "0.033", "8.3"});
  return table;
}

/// One row for each bin that any method has.
Table blur_table(const std::vector<FlightScores>& methods) {
  std::vector<std::string> header{"blur"};
  std::vector<std::string> bins;
  for (const FlightScores& scores : methods) {
    header.push_back(scores.method + " %");
    for (const auto& bin : scores.by_blur)
      if (std::ranges::find(bins, bin.name) == bins.end()) bins.push_back(bin.name);
  }
  Table table(header);
  for (const std::string& name : bins) {
    std::vector<std::string> row{name};
    for (const FlightScores& scores : methods) {
      const auto bin = std::ranges::find(scores.by_blur, name, &FlightScores::BlurBin::name);
      row.push_back(bin == scores.by_blur.end()
                        ? "n/a"
                        : fmt::format("{} of {}", percent_cell(bin->recognition), bin->hits.could_hit));
    }
    table.add(row);
  }
  return table;
}

/// Where a ring's rate is not the paper's: the paper's lies outside the interval of ours.
std::string departure(const paper::RecordedTest& test, const FlightScores& ring) {
  const double paper = test.ring_percent / 100, ours = ring.recognition.value.value_or(0);
  const auto& interval = ring.recognition.interval;
  const bool inside = interval && interval->low <= paper && paper <= interval->high;
  if (inside)
    return fmt::format("Test {}: the paper's {:.1f} % for the ring lies in the interval of ours, {} %.",
                       test.number, test.ring_percent, percent_cell(ring.recognition));
  return fmt::format(
      "Test {}: the ring is recognised on {} % of the frames, {:.1f} points {} the paper's {:.1f} %.",
      test.number, percent_cell(ring.recognition), 100 * std::abs(ours - paper),
      ours < paper ? "below" : "above", test.ring_percent);
}

/// The bins of blur in which most is lost, which says why.
std::string where_it_is_lost(const FlightScores& scores) {
  std::size_t lost = 0;
  const FlightScores::BlurBin* worst = nullptr;
  const auto missed = [](const FlightScores::BlurBin& bin) { return bin.hits.could_hit - bin.hits.hits; };
  for (const auto& bin : scores.by_blur) {
    lost += missed(bin);
    if (!worst || missed(bin) > missed(*worst)) worst = &bin;
  }
  if (!worst || lost == 0) return fmt::format("{} misses nothing that is to be seen.", scores.method);
  return fmt::format("{}: of {} misses {} are at a blur of {}, where it recognises {} %.", scores.method,
                     lost, missed(*worst), worst->name, percent_cell(worst->recognition));
}

std::vector<std::string> sentences_of(const Settings& settings, const Scored& scored) {
  std::vector<std::string> all{
      "The flights were matched to the square markers' rates and to the gaps, and frozen before the ring "
      "detector was "
      "run on them: the ring's rates are predictions, printed as they come.",
      "ARTag read by ALVAR is not at hand; ArUco 6x6_250, as large as the ring and with as many cells "
      "inside, stands for "
      "it. The same flights with AprilTags in its places say what another square marker makes of them.",
      "The paper's own figures do not agree: its text has 86 to 95 % for the ring and around 64 % for ARTag, "
      "Table 2 has "
      "86.5 to 94.1 and 60.3 to 65.6, of which the mean is 62.6.",
      "Nor do its times fit one frame rate: 1000 frames in two minutes are 8.3 a second, 100 frames in 6 s "
      "are 16.7, and "
      "50 intervals of 1000 that last 0.14 s among ones of 0.033 s are 26. The flights have the pattern "
      "paper-6s: the 50 in "
      "1000, the 0.13 s and the 6 s, not the two minutes.",
      "The paper counts over all frames. visible % leaves out targets of which half is not in the picture "
      "(metrics.md), "
      "all frames % does not; one or more %: either of the two square markers."};
  if (settings.quick) all.push_back(fmt::format("QUICK: the first {} frames of test 2 only.", kQuickFrames));
  bool ring_was_run = false;
  for (std::size_t i = 0; i < scored.tests.size(); ++i) {
    const FlightScores* ring = find(scored.tests[i], kRing);
    if (!ring) continue;
    ring_was_run = true;
    if (!settings.quick) all.push_back(departure(test_of(settings, i), *ring));
  }
  if (!ring_was_run)
    all.push_back(fmt::format("There is no detector {}, so the ring was not looked for.", kRing));
  for (const FlightScores& scores : scored.all) all.push_back(where_it_is_lost(scores));
  all.push_back(what_neighbours_cost(scored.all));
  std::erase(all, "");
  return all;
}

LanePlot lanes_of(const Settings& settings, const std::vector<ScoredComparison>& tests) {
  LanePlot plot{.title = settings.quick ? "flight of Table 2 over time" : "Flights of Table 2 over time",
                .x = {"s"},
                .kinds = lane_kinds(),
                .lanes = {}};
  for (std::size_t i = 0; i < tests.size(); ++i) {
    for (const std::string& method : {kSquare, kRing}) {
      auto lane = lane_of(tests[i], method);
      if (!lane) continue;
      lane->name = fmt::format("test {} {}", test_of(settings, i).number, method);
      plot.lanes.push_back(std::move(*lane));
    }
  }
  return plot;
}

Json json_of(const std::vector<FlightScores>& methods) {
  Json all = Json::array();
  for (const FlightScores& scores : methods) all.push_back(json_of(scores));
  return all;
}

Json figures_of(const Settings& settings, const std::vector<ScoredComparison>& tests, const Scored& scored) {
  Json rows = Json::array();
  for (std::size_t i = 0; i < tests.size(); ++i) {
    const paper::RecordedTest& test = test_of(settings, i);
    const Recording& recording = tests[i].stored.recording;
    rows.push_back({{"test", test.number},
                    {"code", std::string(test.code)},
                    {"paper",
                     {{"frames", test.frames},
                      {"artag_percent", test.artag_percent},
                      {"ring_percent", test.ring_percent}}},
                    {"methods", json_of(scored.tests[i])},
                    {"apriltag", i < scored.apriltags.size() ? json_of(scored.apriltags[i]) : Json()},
                    {"gaps", json_of(gap_statistics(recording.captured, recording.period))}});
  }
  return {{"quick", settings.quick}, {"tests", rows}, {"all", json_of(scored.all)}};
}

}  // namespace

std::string what_neighbours_cost(const std::vector<FlightScores>& rings) {
  const FlightScores *published = find(rings, kRing), *apart = find(rings, kRingApart);
  if (!published || !apart) return {};
  return fmt::format(
      "As published, components up to 150 px apart are one cluster, and with what else is that near they "
      "make "
      "no marker. {}, chosen after the predictions to see how much that costs, recognises {} % where {} "
      "recognises {} %.",
      kRingApart, percent_cell(apart->recognition), kRing, percent_cell(published->recognition));
}

Finding finding_of_tests(const Settings& settings, const std::vector<ScoredComparison>& tests,
                         const std::vector<ScoredComparison>& apriltags) {
  const Scored scored{one_by_one(tests), flight_scores(tests), one_by_one(apriltags)};
  Finding finding;
  finding.id = "table-2";
  finding.title = settings.quick ? "Recognition on a flight, ring beside square markers"
                                 : "Recognition on four flights, ring beside square markers";
  finding.tables = {recognition_table(settings, scored), frames_table(settings, scored),
                    gaps_table(settings, tests), blur_table(scored.all)};
  finding.sentences = sentences_of(settings, scored);
  finding.plots = {lanes_of(settings, tests)};
  finding.figures = figures_of(settings, tests, scored);
  return finding;
}

std::vector<Finding> table_2(const Settings& settings, const Methods& methods) {
  std::vector<NamedFlight> tests, twins;
  for (const paper::RecordedTest& test : paper::recorded_tests()) {
    tests.push_back(test_flight(test));
    twins.push_back(with_apriltags(tests.back()));
  }
  if (settings.quick) {
    tests = {first_frames(tests[1], kQuickFrames)};
    twins.clear();
  }
  if (!methods.detectors.find(kAprilTag)) twins.clear();
  const auto flown = fly_and_run(settings, tests, {kRing, kRingApart, kSquare}, methods);
  const auto apriltags =
      twins.empty() ? std::vector<ScoredComparison>{} : fly_and_run(settings, twins, {kAprilTag}, methods);
  return {finding_of_tests(settings, flown, apriltags)};
}

}  // namespace relock::reproduction
