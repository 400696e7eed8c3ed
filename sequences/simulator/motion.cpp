#include "sequences/simulator/motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/random.h"
#include "sequences/simulator/range.h"

namespace relock::simulator {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRadians = kPi / 180;
constexpr int kSines = 24;

// Keys of what is drawn, so that changing one thing leaves the others as they are.
enum Key : std::uint64_t { kDrift = 1, kSway = 4, kVibration = 7, kHeadings = 10, kStrokes = 12 };

/// From 0 to 1 with the least jerk, 0 <= u <= 1; its steepest slope is 15/8.
double smooth(double u) {
  u = std::clamp(u, 0.0, 1.0);
  return u * u * u * (10 + u * (6 * u - 15));
}
constexpr double kSteepest = 15.0 / 8;

}  // namespace

void check_motion(const MotionPlan& plan) {
  check_range("motion: distance_m", plan.distance_m, 0.1, 4);
  check_range("motion: nearest_m", plan.nearest_m, 0.1, plan.distance_m);
  check_range("motion: path_period_s", plan.path_period_s, 0.5, 1e4);
  check_range("motion: sweep_m", plan.sweep_m, 0, 2);
  check_range("motion: drift_m", plan.drift_m, 0, 0.5);
  check_range("motion: sway_deg", plan.sway_deg, 0, 45);
  check_range("motion: vibration_deg", plan.vibration_deg, 0, 10);
  for (const double hz : {plan.drift_hz, plan.sway_hz, plan.vibration_hz})
    check_range("motion: a corner frequency", hz, 0.01, 500);
  check_range("motion: steps_hz", plan.steps_hz, 0, 20);
  check_range("motion: step_deg", plan.step_deg, 0, 90);
  check_range("motion: step_s", plan.step_s, 0.01, 10);
  check_range("motion: strokes_hz", plan.strokes_hz, 0, 20);
  check_range("motion: stroke_deg", plan.stroke_deg, 0, 90);
  check_range("motion: stroke_s", plan.stroke_s, 0.01, 10);
  check_range("motion: most_rate_deg_s", plan.most_rate_deg_s, 1, 5000);
}

Motion::Motion(const MotionPlan& plan, std::uint64_t seed, double axis_m)
    : plan_(plan), seed_(seed), axis_m_(axis_m) {
  check_motion(plan);
  const Random root(seed);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    drift_[axis] = noise(plan.drift_m, plan.drift_hz, root.fork(kDrift + axis).next());
    sway_[axis] = noise(plan.sway_deg * kRadians, plan.sway_hz, root.fork(kSway + axis).next());
    vibration_[axis] =
        noise(plan.vibration_deg * kRadians, plan.vibration_hz, root.fork(kVibration + axis).next());
  }
}

/// Frequencies are drawn one in each of equal parts of the band, so that every seed has the whole spectrum.
Motion::Noise Motion::noise(double rms, double corner_hz, std::uint64_t seed) {
  if (rms == 0) return {};
  Random random(seed);
  Noise sines;
  double power = 0;
  for (int i = 0; i < kSines; ++i) {
    const double hz = 3 * corner_hz * (i + random.uniform()) / kSines;
    const double amplitude = 1 / (1 + hz * hz / (corner_hz * corner_hz));
    power += amplitude * amplitude / 2;
    sines.push_back({amplitude, 2 * kPi * hz, 2 * kPi * random.uniform()});
  }
  for (Sine& sine : sines) sine.amplitude *= rms / std::sqrt(power);
  return sines;
}

double Motion::sum(const Noise& noise, double t) {
  double at = 0;
  for (const Sine& sine : noise) at += sine.amplitude * std::sin(sine.omega * t + sine.phase);
  return at;
}

/// Time is cut into spans of 1/steps_hz; in each, at an instant drawn for it, the heading changes.
double Motion::heading(double t, int axis) const {
  if (plan_.steps_hz == 0 || plan_.step_deg == 0) return 0;
  const double span = 1 / plan_.steps_hz, takes = std::min(plan_.step_s, span / 2);
  const auto now = static_cast<std::int64_t>(std::floor(t / span));
  // Half the limit each: a step goes from one deviation to another, at most twice as far.
  const double most = plan_.most_rate_deg_s * takes / kSteepest / 2;
  const auto drawn = [&](std::int64_t index) {
    Random random = Random(seed_).fork(kHeadings).fork(static_cast<std::uint64_t>(index));
    const double begins = (static_cast<double>(index) + random.uniform()) * span;
    double deviation = 0;
    for (int i = 0; i <= axis; ++i) deviation = random.normal();
    return std::pair(begins, std::clamp(plan_.step_deg * deviation, -most, most) * kRadians);
  };
  // A step may still be going on from the span before; each adds the change it makes.
  double at = drawn(now - 2).second;
  for (std::int64_t i = now - 1; i <= now; ++i) {
    const auto [begins, to] = drawn(i);
    at += (to - drawn(i - 1).second) * smooth((t - begins) / takes);
  }
  return at;
}

double Motion::stroke(double t, int axis) const {
  if (plan_.strokes_hz == 0 || plan_.stroke_deg == 0) return 0;
  const double span = 1 / plan_.strokes_hz, takes = std::min(plan_.stroke_s, span / 2);
  const auto now = static_cast<std::int64_t>(std::floor(t / span));
  const double most = plan_.most_rate_deg_s * takes / 2 / kSteepest;
  double at = 0;
  for (std::int64_t i = now - 1; i <= now; ++i) {
    Random random = Random(seed_).fork(kStrokes).fork(static_cast<std::uint64_t>(i));
    const double u = (t - (static_cast<double>(i) + random.uniform()) * span) / takes;
    double deviation = 0;
    for (int k = 0; k <= axis; ++k) deviation = random.normal();
    at += std::clamp(plan_.stroke_deg * deviation, -most, most) * kRadians *
          (smooth(2 * u) - smooth(2 * u - 1));
  }
  return at;
}

Pose Motion::on_path(double t) const {
  const double phase = 2 * kPi * t / plan_.path_period_s;
  Pose pose;
  pose.position = {0, 0, -plan_.distance_m};
  if (plan_.path == Path::approach) {
    const double near = (1 - std::cos(phase)) / 2;
    pose.position.z() = -plan_.distance_m * std::pow(plan_.nearest_m / plan_.distance_m, near);
  } else if (plan_.path == Path::fly_past) {
    pose.position.x() = plan_.sweep_m * std::sin(phase);
  } else if (plan_.path == Path::revolve) {
    const Eigen::AngleAxisd turn(phase, Eigen::Vector3d::UnitY());
    const Eigen::Vector3d axis(0, 0, axis_m_);
    pose.position = axis + turn * (pose.position - axis);
    pose.rotation = turn;
  }
  return pose;
}

Pose Motion::at(double t) const {
  Pose pose = on_path(t);
  for (std::size_t axis = 0; axis < 3; ++axis)
    pose.position[static_cast<Eigen::Index>(axis)] += sum(drift_[axis], t);
  const auto turned = [&](std::size_t axis) { return sum(sway_[axis], t) + sum(vibration_[axis], t); };
  const double yaw = turned(0) + heading(t, 0) + stroke(t, 0);
  const double pitch = turned(1) + heading(t, 1) + stroke(t, 1);
  pose.rotation = pose.rotation * Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitY()) *
                  Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitX()) *
                  Eigen::AngleAxisd(turned(2), Eigen::Vector3d::UnitZ());
  pose.rotation.normalize();
  return pose;
}

}  // namespace relock::simulator
