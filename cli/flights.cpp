#include "cli/flights.h"

#include <fmt/format.h>

#include "cli/files.h"
#include "cli/print/targets.h"
#include "cli/terminal.h"
#include "core/error.h"
#include "sequences/simulator/flight.h"

namespace relock {

std::filesystem::path flight_folder(const std::filesystem::path& out, const std::string& name) {
  return out / "flights" / name;
}

bool is_flown(const std::filesystem::path& out, const NamedFlight& flight) {
  const auto folder = flight_folder(out, flight.name);
  if (!std::filesystem::exists(folder)) return false;
  if (read_file(folder / "flight.toml") != simulator::flight_plan_text(flight.plan))
    throw Error(fmt::format("{} was flown by another plan; choose another --out or remove {}",
                            folder.string(), out.string()));
  return true;
}

void fly_missing(const std::filesystem::path& out, const std::vector<NamedFlight>& flights, int jobs) {
  std::vector<const NamedFlight*> missing;
  std::int64_t frames = 0, flown = 0;
  for (const NamedFlight& flight : flights) {
    if (is_flown(out, flight)) continue;
    frames += simulator::frames_of(flight.plan);
    missing.push_back(&flight);
  }
  if (missing.empty()) return;
  Progress progress(fmt::format("simulating {} flights", missing.size()), frames);
  for (const NamedFlight* flight : missing) {
    simulator::FlightOptions options;
    options.jobs = jobs;
    options.progress = [&](std::int64_t done) { progress.done(flown + done); };
    flown += simulator::fly(flight->plan, print_target, flight_folder(out, flight->name), options).frames;
  }
}

}  // namespace relock
