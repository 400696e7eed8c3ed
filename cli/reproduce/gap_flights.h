#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/reproduce/experiment.h"
#include "cli/reproduce/flight_runs.h"
#include "cli/reproduce/gap_counts.h"
#include "cli/runs/plan.h"
#include "sequences/open.h"

// The flights on which it is asked whether it is the gaps that trackers lose a marker at (section 4.2.1 of the paper):
// before a ring, of which every frame arrives, each flown twice on the same way, once with the shutter open nearly all
// the time and once nearly never; and what is cut from them (gap_arms.h).

namespace relock::reproduction {

/// A flight and where it is.
struct GapFlight {
  std::uint64_t seed = 1;
  bool blurred = false;
  NamedFlight flight;
};
/// Two for each seed, the sharp one first. QUICK: two seeds, short.
std::vector<GapFlight> gap_flights(const Settings& settings);
/// The flight of a seed; the codes of the ring take turns: 00, 01, 10, 11.
GapFlight gap_flight(std::uint64_t seed, bool blurred, double duration_s);

/// Which frames of the cuts are missing: as by `--gaps` of this.
inline constexpr const char* kGapPattern = "paper-6s";

/// A recording that was cut from a flight.
struct CutFlight {
  GapCell cell;
  Cut cut;
  std::filesystem::path folder;
};
/// Flies and cuts what is missing into OUT/flights. In order of flight, then arm.
std::vector<CutFlight> fly_and_cut(const Settings& settings, const std::vector<GapFlight>& flights,
                                   const std::vector<GapArm>& arms);

/// Runs methods on all of them and counts.
std::vector<GapCount> run_and_count(const Settings& settings, const std::vector<CutFlight>& flights,
                                    const std::vector<std::string>& wanted, Protocol protocol,
                                    const Methods& methods);

}  // namespace relock::reproduction
