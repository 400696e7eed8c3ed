#include "core/error.h"
#include "core/nearest.h"
#include "sequences/simulator/flight_plan.h"

#include <fmt/format.h>

namespace relock::simulator {
namespace {

/// The camera of the paper's quadcopter: 640x360, 92 degrees, 30 Hz, a small noisy sensor indoors.
FlightPlan ardrone() {
  FlightPlan plan;
  plan.preset = "ardrone";
  plan.camera = {.width = 640, .height = 360, .diagonal_deg = 92, .rate_hz = 30};
  return plan;
}

FlightPlan sized(double width, double height) {
  FlightPlan plan = ardrone();
  plan.camera.width = width, plan.camera.height = height;
  return plan;
}

FlightPlan calm() {
  FlightPlan plan = ardrone();
  plan.motion.drift_m = 0.03, plan.motion.sway_deg = 0.5, plan.motion.steps_hz = 0;
  plan.motion.distance_m = 1;
  return plan;
}

FlightPlan violent() {
  FlightPlan plan = ardrone();
  plan.motion.sway_deg = 3, plan.motion.sway_hz = 2;
  plan.motion.steps_hz = 1, plan.motion.step_deg = 12, plan.motion.step_s = 0.2;
  plan.motion.strokes_hz = 0.7, plan.motion.stroke_deg = 14, plan.motion.stroke_s = 0.25;
  plan.motion.most_rate_deg_s = 500;
  plan.exposure.time_ms = 20;
  return plan;
}

FlightPlan with_path(Path path) {
  FlightPlan plan = ardrone();
  plan.motion.path = path;
  return plan;
}

FlightPlan approach() {
  FlightPlan plan = with_path(Path::approach);
  plan.motion.distance_m = 1.77, plan.motion.nearest_m = 0.24;
  plan.motion.drift_m = 0.02, plan.motion.step_deg = 3;
  return plan;
}

FlightPlan box() {
  FlightPlan plan = with_path(Path::revolve);
  plan.scene.arrangement = Arrangement::box;
  plan.motion.path_period_s = 20, plan.motion.distance_m = 1.2;
  plan.targets = {{"ring:00"}, {"ring:01"}, {"ring:10"}, {"ring:11"}};
  return plan;
}

FlightPlan wall4() {
  FlightPlan plan = ardrone();
  plan.targets = {{"ring:00"}, {"ring:01"}, {"ring:10"}, {"ring:11"}};
  return plan;
}

FlightPlan paper() {
  FlightPlan plan = ardrone();
  plan.scene.arrangement = Arrangement::paper;
  plan.targets = {{"ring:01"}, {"aruco6x6_250:0"}, {"aruco6x6_250:1"}};
  return plan;
}

FlightPlan dusk() {
  FlightPlan plan = ardrone();
  plan.exposure.automatic = true;
  plan.exposure.time_ms = 4, plan.exposure.longest_ms = 33, plan.exposure.light_end = 0.06;
  return plan;
}

FlightPlan rolling() {
  FlightPlan plan = ardrone();
  plan.exposure.readout_ms = 25;
  return plan;
}

std::vector<FlightPreset> all() {
  std::vector<FlightPreset> presets{
      {"ardrone", "a quadcopter's camera, 640x360 at 30 Hz, 92 degrees; hovers and looks about", ardrone()},
      {"calm", "the same, hovering quietly", calm()},
      {"violent", "the same, struck and jerked", violent()},
      {"approach", "the same, near and far: a target of 150 mm has 30 to 220 px", approach()},
      {"fly-past", "the same, to and fro along the wall", with_path(Path::fly_past)},
      {"box", "the same, round a box with a ring on each side (the paper's section 4.2)", box()},
      {"wall4", "the same, before four rings", wall4()},
      {"paper", "the same, before a ring between two ArUco markers (the paper's section 4.2)", paper()},
      {"dusk", "the same, as light falls: exposures grow from 4 to 33 ms, then noise does", dusk()},
      {"rolling", "the same, with a shutter that takes 25 ms from top to bottom", rolling()},
      {"vga", "the same at 640x480", sized(640, 480)},
      {"720p", "the same at 1280x720", sized(1280, 720)},
      {"1080p", "the same at 1920x1080", sized(1920, 1080)},
  };
  for (FlightPreset& preset : presets) preset.plan.preset = preset.name;
  return presets;
}

}  // namespace

const std::vector<FlightPreset>& flight_presets() {
  static const std::vector<FlightPreset> presets = all();
  return presets;
}

FlightPlan flight_preset(const std::string& name) {
  std::vector<std::string> names;
  for (const FlightPreset& preset : flight_presets()) {
    if (preset.name == name) return preset.plan;
    names.push_back(preset.name);
  }
  throw Error(fmt::format("no preset is called \"{}\"{}; they are {}", name, did_you_mean(name, names),
                          fmt::join(names, ", ")));
}

}  // namespace relock::simulator
