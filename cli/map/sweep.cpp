#include "cli/map/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/flights.h"
#include "core/error.h"
#include "sequences/simulator/camera.h"

namespace relock::maps {
namespace {

constexpr double kShortestFlight_s = 0.5;

void check_increasing(const std::vector<double>& values, const char* option, double least, double most) {
  if (values.empty()) throw Error(fmt::format("{} names none", option));
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!(values[i] >= least && values[i] <= most))
      throw Error(fmt::format("{} has {:g}; each must be from {:g} to {:g}", option, values[i], least, most));
    if (i > 0 && values[i] <= values[i - 1])
      throw Error(
          fmt::format("{} must increase, and {:g} comes after {:g}", option, values[i], values[i - 1]));
  }
}

/// Metres across that a target needs to be `size_px` large from the path's distance.
double size_m(const simulator::FlightPlan& flight, double size_px) {
  const Size picture{static_cast<int>(flight.camera.width), static_cast<int>(flight.camera.height)};
  return size_px * flight.motion.distance_m /
         simulator::focal_of_diagonal(picture, flight.camera.diagonal_deg);
}

PlannedFlight flight(const SweepPlan& plan, std::size_t row, std::optional<std::size_t> column, int seed) {
  const double exposure_ms = plan.exposures_ms[row];
  PlannedFlight result{fmt::format("exposure-{:g}-seed-{}", exposure_ms, seed), row, column,
                       static_cast<std::uint64_t>(seed), plan.flight};
  result.plan.seed = result.seed;
  result.plan.exposure.time_ms = exposure_ms;
  if (column) {
    const double size_px = plan.columns[*column];
    result.name = fmt::format("exposure-{:g}-size-{:g}-seed-{}", exposure_ms, size_px, seed);
    result.plan.targets.front().size_m = size_m(plan.flight, size_px);
  }
  return result;
}

}  // namespace

Across parse_across(const std::string& word) {
  for (const Across across : {Across::gap, Across::rate, Across::size})
    if (word == to_string(across)) return across;
  throw Error(fmt::format("no map has the axes \"{}\"; they are gap,blur, rate,blur and size,blur", word));
}

const char* to_string(Across across) {
  switch (across) {
    case Across::gap:
      return "gap";
    case Across::rate:
      return "rate";
    case Across::size:
      break;
  }
  return "size";
}

simulator::FlightPlan map_flight() {
  simulator::FlightPlan flight = simulator::flight_preset("calm");
  flight.duration_s = 5;
  flight.camera.width = 320, flight.camera.height = 240;
  flight.motion.distance_m = 0.9;
  flight.motion.sway_deg = 10, flight.motion.sway_hz = 1.5;
  flight.targets = {{"apriltag36h11:0", 0.2}};
  return flight;
}

std::vector<double> default_columns(Across across) {
  switch (across) {
    case Across::gap:
      return {1, 2, 4, 6, 8, 12};
    case Across::rate:
      return {3, 5, 7.5, 10, 15, 30};
    case Across::size:
      break;
  }
  return {20, 28, 40, 56, 80};
}

void check_sweep(const SweepPlan& plan) {
  const double period_ms = 1000 / plan.flight.camera.rate_hz;
  check_increasing(plan.exposures_ms, "--exposures", 0.01, period_ms);
  switch (plan.across) {
    case Across::gap:
      check_increasing(plan.columns, "--across", 1, 1000);
      for (const double slots : plan.columns)
        if (slots != std::floor(slots))
          throw Error("--across: the length of a gap is a whole number of slots");
      break;
    case Across::rate:
      check_increasing(plan.columns, "--across", 0.1, plan.flight.camera.rate_hz);
      break;
    case Across::size:
      check_increasing(plan.columns, "--across", 5, 1000);
      break;
  }
  if (!(plan.gap_share > 0 && plan.gap_share <= 1)) throw Error("--gap-share must be above 0 and at most 1");
  if (!(plan.flight.duration_s >= kShortestFlight_s))
    throw Error(fmt::format(
        "a map's flights of {:g} s are too short to lose a target and have it back; --duration must "
        "be {:g} s or more",
        plan.flight.duration_s, kShortestFlight_s));
  if (plan.seeds < 1 || plan.seeds > 1000) throw Error("--seeds must be from 1 to 1000");
  if (plan.flight.targets.size() != 1)
    throw Error("the flight of a map has one target, so that every method is asked about the same");
  if (plan.flight.timing.gaps != "none")
    throw Error("the flight of a map has no gaps of its own: leave timing.gaps out of its plan");
  for (const PlannedFlight& flight : flights_of(plan)) simulator::check_flight_plan(flight.plan);
}

std::vector<PlannedFlight> flights_of(const SweepPlan& plan) {
  std::vector<PlannedFlight> all;
  for (int seed = 1; seed <= plan.seeds; ++seed) {
    for (std::size_t row = 0; row < plan.exposures_ms.size(); ++row) {
      if (plan.across == Across::size) {
        for (std::size_t column = 0; column < plan.columns.size(); ++column)
          all.push_back(flight(plan, row, column, seed));
      } else {
        all.push_back(flight(plan, row, {}, seed));
      }
    }
  }
  return all;
}

std::filesystem::path folder_of(const SweepPlan& plan, const PlannedFlight& flight) {
  return flight_folder(plan.out, flight.name);
}

bool is_flown(const SweepPlan& plan, const PlannedFlight& flight) {
  return relock::is_flown(plan.out, {flight.name, flight.plan});
}

std::string gaps_of(const SweepPlan& plan, std::size_t column) {
  switch (plan.across) {
    case Across::gap:
      return fmt::format("gaps({:g},{:g})", plan.columns[column], plan.gap_share);
    case Across::rate:
      return fmt::format("fps({:g})", plan.columns[column]);
    case Across::size:
      break;
  }
  return "none";
}

}  // namespace relock::maps
