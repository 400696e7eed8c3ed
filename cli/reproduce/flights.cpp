#include "cli/reproduce/flights.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "core/error.h"
#include "sequences/simulator/flight.h"

namespace relock::reproduction {
namespace {

using simulator::FlightPlan;

constexpr double kMarker_m = 0.3;  // at 1.2 m it has 89 px
const std::string kArUco = "aruco6x6_250:", kAprilTag = "apriltag36h11:";

/// A cheap quadcopter indoors: a shutter open nearly all the time, a plain lens, and a camera that is swayed, turned
/// and struck. What differs between flights is how much it sways.
FlightPlan frozen(const char* preset, std::uint64_t seed, double sway_deg, double duration_s) {
  FlightPlan plan = simulator::flight_preset(preset);
  plan.seed = seed;
  plan.duration_s = duration_s;
  plan.timing.gaps = "paper-6s";
  plan.motion.distance_m = 1.2;
  plan.motion.drift_m = 0.1, plan.motion.drift_hz = 0.5;
  plan.motion.sway_deg = sway_deg, plan.motion.sway_hz = 2;
  plan.motion.steps_hz = 0.5, plan.motion.step_deg = 6, plan.motion.step_s = 0.3;
  plan.motion.strokes_hz = 1, plan.motion.stroke_deg = 10, plan.motion.stroke_s = 0.3;
  plan.motion.most_rate_deg_s = 300;
  plan.exposure.time_ms = 30;
  plan.exposure.step_px = 2;  // the lens blurs more than steps of 2 px show
  plan.sensor.defocus_px = 0.8;
  return plan;
}

FlightPlan on_the_wall(const std::string& code, std::uint64_t seed, double sway_deg, double duration_s) {
  FlightPlan plan = frozen("paper", seed, sway_deg, duration_s);
  plan.scene.spacing_m = 0.42;
  plan.targets = {{"ring:" + code, kMarker_m}, {kArUco + "0", kMarker_m}, {kArUco + "1", kMarker_m}};
  return plan;
}

FlightPlan round_the_box(const std::array<std::string, 4>& markers) {
  FlightPlan plan = frozen("box", 5, 4.2, 34.37);
  plan.motion.path_period_s = 18;
  plan.targets.clear();
  for (const std::string& marker : markers) plan.targets.push_back({marker, kMarker_m});
  return plan;
}

}  // namespace

NamedFlight test_flight(const paper::RecordedTest& test) {
  struct Frozen {
    double sway_deg, duration_s;
  };
  constexpr std::array<Frozen, 4> all{{{4.15, 72.07}, {4.55, 63.87}, {4.95, 65.17}, {4.65, 66.8}}};
  const auto [sway_deg, duration_s] = all.at(static_cast<std::size_t>(test.number - 1));
  return {fmt::format("test-{}", test.number),
          on_the_wall(std::string(test.code), static_cast<std::uint64_t>(test.number), sway_deg, duration_s)};
}

NamedFlight box_of_rings() {
  return {"box-rings", round_the_box({"ring:00", "ring:01", "ring:10", "ring:11"})};
}

NamedFlight box_of_squares() {
  return {"box-squares", round_the_box({kArUco + "0", kArUco + "1", kArUco + "2", kArUco + "3"})};
}

NamedFlight with_apriltags(NamedFlight flight) {
  flight.name += "-apriltag";
  for (simulator::PlannedTarget& target : flight.plan.targets)
    if (target.name.starts_with(kArUco)) target.name.replace(0, kArUco.size(), kAprilTag);
  return flight;
}

NamedFlight first_frames(NamedFlight flight, std::int64_t frames) {
  if (simulator::frames_of(flight.plan) < frames)
    throw Error(fmt::format("{} has no {} frames", flight.name, frames));
  flight.name += "-quick";
  // What arrives of a flight's first seconds does not depend on how long it goes on.
  const double rate_hz = flight.plan.camera.rate_hz;
  auto fewest = frames, most = static_cast<std::int64_t>(std::ceil(flight.plan.duration_s * rate_hz));
  while (fewest < most) {
    const std::int64_t middle = (fewest + most) / 2;
    flight.plan.duration_s = static_cast<double>(middle) / rate_hz;
    if (simulator::frames_of(flight.plan) < frames)
      fewest = middle + 1;
    else
      most = middle;
  }
  flight.plan.duration_s = static_cast<double>(most) / rate_hz;
  return flight;
}

}  // namespace relock::reproduction
