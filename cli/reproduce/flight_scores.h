#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/comparison.h"
#include "cli/plot/plot.h"
#include "cli/reproduce/experiment.h"
#include "cli/scores/judged.h"

// What methods made of flights, and what that comes to.

namespace relock::reproduction {

/// A share, and its 95 % interval where it can be told.
struct Share {
  std::optional<double> value;
  std::optional<Interval> interval;
};
/// What a method did on some flights, all targets that it was asked about pooled.
struct FlightScores {
  std::string method;
  std::size_t frames = 0, targets = 0;  ///< targets: in each flight
  Share recognition = {};               ///< of the visible targets (metrics.md section 6)
  Share of_all_frames = {};             ///< Hits / (frames * targets): as if each were always to be seen
  Share any = {};                       ///< frames with a Hit on at least one target / frames
  Share precision = {};
  std::size_t wrong_codes = 0;      ///< verdicts WrongId
  std::size_t false_sightings = 0;  ///< verdicts Stray and FalseAlarm, and sightings of nothing
  struct BlurBin {
    std::string name;  ///< "5-10 px"
    HitCount hits;
    Share recognition;
  };
  std::vector<BlurBin> by_blur = {};  ///< those that hold frames
};
/// Of every method, yardsticks left out, by name; all flights pooled. They must have as many targets each.
std::vector<FlightScores> flight_scores(const std::vector<ScoredComparison>& flights);
/// Nothing when the method was not run.
const FlightScores* find(const std::vector<FlightScores>& scores, std::string_view method);

/// Whether an interval is longer than 0.1 s, told by its slots: three at 30 Hz are not.
bool above_100ms(Duration interval, Duration period);

/// How a recording's frames came.
struct GapStatistics {
  std::size_t frames = 0;
  double length_s = 0;              ///< from the first frame to the last
  double above_100ms_per_1000 = 0;  ///< intervals longer than 0.1 s, that is of more slots than fit in it
  double longest_s = 0, shortest_s = 0, mean_s = 0;  ///< intervals
};
/// Needs two frames.
GapStatistics gap_statistics(const std::vector<Time>& captured, Duration period);

/// What a method said over time, for a LanePlot whose kinds are `lane_kinds()`: detected is a frame with a Hit on at
/// least one target. Nothing when the method was not run.
std::optional<PlotLane> lane_of(const ScoredComparison& flight, const std::string& method);
const std::vector<std::string>& lane_kinds();

/// "62.4 [60.1, 64.7]", percent; "n/a" without a value.
std::string percent_cell(const Share& share);
Json json_of(const Share& share);
Json json_of(const FlightScores& scores);
Json json_of(const GapStatistics& gaps);

}  // namespace relock::reproduction
