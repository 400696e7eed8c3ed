// Figure 12 of the paper: round a box with a marker on each side, once with rings and once with square ones.

#include <fmt/format.h>

#include "cli/reproduce/flight_experiments.h"
#include "cli/reproduce/flight_runs.h"
#include "cli/reproduce/flights.h"

namespace relock::reproduction {
namespace {

const std::string kSquare = "aruco";

/// What one method made of its flight.
struct Round {
  std::string marker, method;
  double paper_percent = 0;
  const ScoredComparison* flight;  ///< null: it was not run
  std::vector<FlightScores> scores = {};
};

std::vector<Round> rounds_of(const ScoredComparison& squares, const ScoredComparison* rings) {
  std::vector<Round> rounds{{"square", kSquare, 60, &squares}, {"ring", kRing, 90, rings}};
  for (Round& round : rounds)
    if (round.flight) round.scores = flight_scores({*round.flight});
  return rounds;
}

Table detection_table(const std::vector<Round>& rounds) {
  Table table({"markers", "method", "frames", "paper %", "detected %", "of visible markers %", "wrong codes",
               "false", "precision %"});
  for (const Round& round : rounds) {
    const FlightScores* scores = find(round.scores, round.method);
    if (!scores) {
      table.add({round.marker, round.method, "", fmt::format("{:g}", round.paper_percent), "not run", "", "",
                 "", ""});
      continue;
    }
    table.add({round.marker, round.method, fmt::format("{}", scores->frames),
               fmt::format("{:g}", round.paper_percent), percent_cell(scores->any),
               percent_cell(scores->recognition), fmt::format("{}", scores->wrong_codes),
               fmt::format("{}", scores->false_sightings), percent_cell(scores->precision)});
  }
  return table;
}

LanePlot lanes_of(const std::vector<Round>& rounds) {
  LanePlot plot{
      .title = "Round the box: detection over time", .x = {"s"}, .kinds = lane_kinds(), .lanes = {}};
  for (const Round& round : rounds) {
    if (!round.flight) continue;
    if (auto lane = lane_of(*round.flight, round.method)) plot.lanes.push_back(std::move(*lane));
  }
  return plot;
}

Json figures_of(const std::vector<Round>& rounds) {
  Json all = Json::array();
  for (const Round& round : rounds) {
    Json one{{"markers", round.marker}, {"paper_percent", round.paper_percent}};
    const FlightScores* scores = find(round.scores, round.method);
    one["scores"] = scores ? json_of(*scores) : Json();
    if (round.flight) {
      const Recording& recording = round.flight->stored.recording;
      one["gaps"] = json_of(gap_statistics(recording.captured, recording.period));
    }
    all.push_back(one);
  }
  return {{"rounds", all}};
}

}  // namespace

Finding finding_of_box(const ScoredComparison& squares, const ScoredComparison* rings) {
  const std::vector<Round> rounds = rounds_of(squares, rings);
  Finding finding;
  finding.id = "figure-12";
  finding.title = "Round a box with a marker on each side";
  finding.tables = {detection_table(rounds)};
  finding.sentences = {
      "Both flights go the same way, blur and gaps too; only the markers differ. They were matched to the "
      "paper's around "
      "60 % for ARTag and frozen before the ring detector was run on them: the ring's rate is a prediction.",
      "detected %: frames on which one or more of the four are recognised, which is how we read the paper's "
      "overall rate; "
      "of visible markers %: each side on its own, though it is seen at a flat angle as the camera goes on "
      "to the next."};
  if (!find(rounds[1].scores, kRing))
    finding.sentences.push_back(
        fmt::format("There is no detector {}, so the ring was not looked for.", kRing));
  finding.sentences.push_back(what_neighbours_cost(rounds[1].scores));
  std::erase(finding.sentences, "");
  finding.plots = {lanes_of(rounds)};
  finding.figures = figures_of(rounds);
  return finding;
}

std::vector<Finding> figure_12(const Settings& settings, const Methods& methods) {
  if (settings.quick) return {};
  const auto squares = fly_and_run(settings, {box_of_squares()}, {kSquare}, methods);
  if (!methods.detectors.find(kRing)) return {finding_of_box(squares.front(), nullptr)};
  const auto rings = fly_and_run(settings, {box_of_rings()}, {kRing, kRingApart}, methods);
  return {finding_of_box(squares.front(), &rings.front())};
}

}  // namespace relock::reproduction
