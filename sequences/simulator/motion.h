#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sequences/simulator/camera.h"

namespace relock::simulator {

/// Where the camera means to fly.
enum class Path : std::uint8_t {
  hover,     ///< stays at distance_m before the target
  approach,  ///< between distance_m and nearest_m and back, once in path_period_s, smoothly
  fly_past,  ///< to and fro along the wall, sweep_m either way, once in path_period_s, looking straight ahead
  revolve,   ///< round the target at distance_m, once in path_period_s, looking at the axis
};

/// How a quadcopter moves. Everything is a closed form of time, drawn once from the seed, so that any
/// instant can be asked for in any order.
///
/// On the path come, in each of the six degrees of freedom, sums of sines whose power spectrum is flat up to a corner
/// frequency and falls with its fourth power above (a driven mass): slow drift, sway, and fast vibration. And
/// jerks of minimum jerk (Flash and Hogan 1985): steps to another heading, and strokes there and back.
struct MotionPlan {
  Path path = Path::hover;
  double distance_m = 1.5;
  double nearest_m = 0.3;
  double path_period_s = 12;
  double sweep_m = 1.2;

  double drift_m = 0.08;        ///< RMS of each axis
  double drift_hz = 0.4;        ///< corner frequency
  double sway_deg = 2.2;        ///< RMS of yaw, pitch and roll
  double sway_hz = 1.2;         ///< corner frequency
  double vibration_deg = 0.03;  ///< RMS of yaw, pitch and roll
  double vibration_hz = 12;     ///< corner frequency

  double steps_hz = 0.5;   ///< how often yaw and pitch take another heading
  double step_deg = 8;     ///< RMS of the headings' deviation from the target
  double step_s = 0.3;     ///< a step takes this long
  double strokes_hz = 0;   ///< how often the camera is struck there and back
  double stroke_deg = 15;  ///< RMS
  double stroke_s = 0.2;   ///< there and back

  double most_rate_deg_s = 250;  ///< steps and strokes that would turn faster are made smaller
};

/// Throws Error on values that no motion has.
void check_motion(const MotionPlan& plan);

/// One flight's motion.
class Motion {
 public:
  /// `axis_m`: how far behind the origin the axis is that `revolve` goes round.
  Motion(const MotionPlan& plan, std::uint64_t seed, double axis_m = 0);
  /// Where the camera is, `t` seconds after the flight's begin.
  Pose at(double t) const;

 private:
  struct Sine {
    double amplitude, omega, phase;
  };
  using Noise = std::vector<Sine>;

  static Noise noise(double rms, double corner_hz, std::uint64_t seed);
  static double sum(const Noise& noise, double t);
  double heading(double t, int axis) const;
  double stroke(double t, int axis) const;
  Pose on_path(double t) const;

  MotionPlan plan_;
  std::uint64_t seed_;
  double axis_m_;
  std::array<Noise, 3> drift_, sway_, vibration_;
};

}  // namespace relock::simulator
