#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "sequences/simulator/exposure.h"
#include "sequences/simulator/motion.h"
#include "sequences/simulator/scene.h"
#include "sequences/simulator/sensor.h"
#include "sequences/simulator/transport.h"

namespace relock::simulator {

/// Size and pace of pictures, and the lens.
struct CameraPlan {
  double width = 640, height = 360;  ///< px
  double diagonal_deg = 92;          ///< of the view
  double rate_hz = 30;
  double k1 = 0, k2 = 0;  ///< radial distortion (camera.h)
};

/// When frames are taken and which of them arrive.
struct TimingPlan {
  double jitter_ms =
      0;  ///< RMS by which exposures are off the even pace; at most a third of the period. Stamps tell the true times
  std::string gaps = "none";  ///< frames that are lost (sequences/gaps.h): they are not in the recording
};

struct PlannedTarget {
  std::string name = "ring:01";  ///< as `relock marker` takes it
  double size_m = 0.15;          ///< diameter or side
};

/// Everything a simulated flight is made of: the same plan makes the same bytes.
struct FlightPlan {
  std::string preset = "ardrone";  ///< what is not stated is as in this one
  std::uint64_t seed = 1;
  double duration_s = 10;
  CameraPlan camera;
  TimingPlan timing;
  MotionPlan motion;
  ExposurePlan exposure;
  ScenePlan scene;
  SensorPlan sensor;
  TransportPlan transport;
  std::vector<PlannedTarget> targets{{}};
};

struct FlightPreset {
  std::string name;
  std::string sentence;
  FlightPlan plan;
};
const std::vector<FlightPreset>& flight_presets();
/// Throws Error that names the nearest one when there is none of this name.
FlightPlan flight_preset(const std::string& name);

/// A plan file: TOML, `preset`, `seed`, `duration_s`, the tables [camera], [timing], [motion], [exposure], [scene],
/// [sensor], [transport] with the fields of the structs above by their names, and [[target]] with name and size_m. A
/// background's path is relative to the file. Throws Error with file, line and column.
FlightPlan read_flight_plan(const std::filesystem::path& file);
/// The plan with every quantity stated: the file that `read_flight_plan` makes the same plan of.
std::string flight_plan_text(const FlightPlan& plan);

/// Throws Error on what no flight can be: see the checks of the parts.
void check_flight_plan(const FlightPlan& plan);

}  // namespace relock::simulator
