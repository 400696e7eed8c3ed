#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/map/cells.h"
#include "cli/method_spec.h"
#include "sequences/simulator/flight_plan.h"

namespace relock::maps {

/// What the columns of a map differ in. The rows differ in blur.
enum class Across : std::uint8_t {
  gap,   ///< length of the gaps, slots
  rate,  ///< frame rate, Hz
  size,  ///< size D of the target, px
};
/// "gap", "rate" or "size"; throws Error for another word.
Across parse_across(const std::string& word);
const char* to_string(Across across);

/// What a map is made of: flights that differ in blur, and what is lost of them.
///
/// Blur is set by the exposure time and by nothing else: one seed flies the same way before the same wall in
/// every row, as bright and as noisy, so the target moves as far from frame to frame and over a gap. Gaps and
/// rates take frames away from the same flights.
struct SweepPlan {
  Across across = Across::gap;
  std::vector<double> columns{1, 2, 4, 6, 8, 12};       ///< in the unit of `across`, increasing
  std::vector<double> exposures_ms{2, 10, 18, 26, 33};  ///< increasing
  double gap_share = 0.05;                              ///< Across::gap: of the intervals, how many are gaps
  int seeds = 5;                                        ///< 1, 2, … of flight and gaps
  simulator::FlightPlan flight;  ///< seed, exposure time and (Across::size) the target's size are set
  std::vector<MethodSpec> methods;
  std::filesystem::path out = "map";
};

/// The flight that is flown unless another is asked for: 5 s, 320x240 at 30 Hz, before one apriltag36h11:0 of
/// about 45 px, swaying so that it moves by a quarter of its size from frame to frame.
simulator::FlightPlan map_flight();
std::vector<double> default_columns(Across across);

/// Throws Error naming what is out of range.
void check_sweep(const SweepPlan& plan);

/// One flight of a sweep: OUT/flights/NAME.
struct PlannedFlight {
  std::string name;                        ///< "exposure-8-seed-1", "exposure-8-size-40-seed-1"
  std::size_t row = 0;                     ///< which exposure
  std::optional<std::size_t> column = {};  ///< which size; empty: it serves the whole row
  std::uint64_t seed = 1;
  simulator::FlightPlan plan;
};
/// Seed by seed.
std::vector<PlannedFlight> flights_of(const SweepPlan& plan);
std::filesystem::path folder_of(const SweepPlan& plan, const PlannedFlight& flight);
/// Whether it is there already. Throws Error when what is there was flown by another plan.
bool is_flown(const SweepPlan& plan, const PlannedFlight& flight);

/// What a column takes away from a flight: gaps(4,0.05), fps(10), none.
std::string gaps_of(const SweepPlan& plan, std::size_t column);

/// True blur of the flights of a row, over all frames on which a target is visible.
struct Blur {
  double mean_px = 0;
  double mean_percent = 0;  ///< of the target's size D
};

/// A map that was measured.
struct MeasuredMap {
  SweepPlan plan;
  std::vector<Blur> blur;          ///< of every row
  std::vector<MethodMap> methods;  ///< as the plan has them
  /// Of every method: locked share that was possible there, the mean of the flights that see the target.
  std::vector<Grid<std::optional<double>>> ceilings;
};

}  // namespace relock::maps
