#include "cli/reproduce/gap_flights.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/reproduce/contenders.h"

namespace relock::reproduction {
namespace {

constexpr std::uint64_t kSeeds = 10, kQuickSeeds = 2;
constexpr double kDuration_s = 24, kQuickDuration_s = 2.5;
constexpr double kBlurred_ms = 28, kSharp_ms = 2;

/// "gaps" of "all frames": folders have no spaces in their names.
std::string in_folder_names(GapArm arm) {
  std::string name(to_string(arm));
  std::ranges::replace(name, ' ', '-');
  return name;
}

void cut_missing(const Settings& settings, const GapFlight& flown, CutFlight& to) {
  const auto folder = flight_folder(settings.out, flown.flight.name);
  const std::string name = fmt::format("{}-{}", flown.flight.name, in_folder_names(to.cell.arm));
  to.folder = flight_folder(settings.out, name);
  const Recording recording = read_truth(folder);
  to.cut = cut(to.cell.arm, recording.captured, recording.period, GapPattern::parse(kGapPattern), flown.seed);
  write_cut(folder, cut_recording(recording, to.cut, name), to.cut, to.folder);
}

}  // namespace

GapFlight gap_flight(std::uint64_t seed, bool blurred, double duration_s) {
  simulator::FlightPlan plan = simulator::flight_preset("ardrone");
  plan.seed = seed;
  plan.duration_s = duration_s;
  plan.camera.width = 320, plan.camera.height = 240;
  plan.motion.distance_m = 0.65;
  plan.motion.drift_m = 0.05, plan.motion.drift_hz = 0.5;
  plan.motion.sway_deg = 3, plan.motion.sway_hz = 1.5;
  plan.motion.steps_hz = 0.5, plan.motion.step_deg = 5, plan.motion.step_s = 0.3;
  plan.motion.strokes_hz = 1, plan.motion.stroke_deg = 8, plan.motion.stroke_s = 0.3;
  plan.motion.most_rate_deg_s = 250;
  plan.exposure.time_ms = blurred ? kBlurred_ms : kSharp_ms;
  plan.exposure.step_px = 2;
  plan.sensor.defocus_px = 0.6;
  const std::string& code = ring_codes()[(seed - 1) % ring_codes().size()];
  plan.targets = {{ring_target(code), 0.2}};
  return {seed, blurred, {fmt::format("ring-{}-{}", blurred ? "blurred" : "sharp", seed), plan}};
}

std::vector<GapFlight> gap_flights(const Settings& settings) {
  std::vector<GapFlight> flights;
  for (std::uint64_t seed = 1; seed <= (settings.quick ? kQuickSeeds : kSeeds); ++seed)
    for (const bool blurred : {false, true})
      flights.push_back(gap_flight(seed, blurred, settings.quick ? kQuickDuration_s : kDuration_s));
  return flights;
}

std::vector<CutFlight> fly_and_cut(const Settings& settings, const std::vector<GapFlight>& flights,
                                   const std::vector<GapArm>& arms) {
  std::vector<NamedFlight> named;
  for (const GapFlight& flight : flights) named.push_back(flight.flight);
  fly_missing(settings.out, named, settings.jobs);
  std::vector<CutFlight> all;
  for (const GapFlight& flight : flights)
    for (const GapArm arm : arms) {
      all.push_back({.cell = {arm, flight.blurred, flight.seed}, .cut = {}, .folder = {}});
      cut_missing(settings, flight, all.back());
    }
  return all;
}

std::vector<GapCount> run_and_count(const Settings& settings, const std::vector<CutFlight>& flights,
                                    const std::vector<std::string>& wanted, Protocol protocol,
                                    const Methods& methods) {
  std::vector<std::filesystem::path> folders;
  for (const CutFlight& flight : flights) folders.push_back(flight.folder);
  const auto runs = run_on(settings, folders, wanted, protocol, methods);
  std::vector<GapCount> all;
  for (std::size_t i = 0; i < flights.size(); ++i)
    for (GapCount& count : counts_of(runs[i], flights[i].cell, flights[i].cut))
      all.push_back(std::move(count));
  return all;
}

}  // namespace relock::reproduction
