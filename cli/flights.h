#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sequences/simulator/flight_plan.h"

// Flights that a verb makes for its own use: OUT/flights/NAME. They are kept, and not flown again.

namespace relock {

struct NamedFlight {
  std::string name;
  simulator::FlightPlan plan;
};

std::filesystem::path flight_folder(const std::filesystem::path& out, const std::string& name);

/// Whether it is there already. Throws Error when what is there was flown by another plan.
bool is_flown(const std::filesystem::path& out, const NamedFlight& flight);

/// Flies what is not there yet, and tells on a terminal how long that will take. Every flight is there whole or not
/// at all; the bytes are the same for any number of `jobs`.
void fly_missing(const std::filesystem::path& out, const std::vector<NamedFlight>& flights, int jobs);

}  // namespace relock
