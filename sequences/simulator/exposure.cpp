#include "sequences/simulator/exposure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "sequences/simulator/range.h"

namespace relock::simulator {

void check_exposure(const ExposurePlan& plan, double period_s) {
  const double most_ms = 1000 * period_s;
  check_range("exposure: time_ms", plan.time_ms, 0.001, most_ms);
  if (plan.automatic) check_range("exposure: longest_ms", plan.longest_ms, plan.time_ms, most_ms);
  check_range("exposure: light", plan.light, 1e-3, 10);
  check_range("exposure: light_end", plan.light_end, 1e-3, 10);
  check_range("exposure: readout_ms", plan.readout_ms, 0, most_ms);
  check_range("exposure: step_px", plan.step_px, 0.1, 10);
  check_range("exposure: most_steps", plan.most_steps, 1, 1024);
}

Exposure::Exposure(const ExposurePlan& plan, const Motion& motion, double middle_s, double flight_share)
    : middle_s_(middle_s), duration_s_(plan.time_ms / 1000), readout_s_(plan.readout_ms / 1000) {
  const double light = plan.light * std::pow(plan.light_end / plan.light, flight_share);
  if (plan.automatic) {
    duration_s_ = std::min(plan.time_ms / light, plan.longest_ms) / 1000;
    light_ = light * duration_s_ * 1000 / plan.time_ms;
    gain_ = std::max(1.0, 1 / light_);
    light_ = std::min(light_, 1 / gain_);  // brighter than full light: a shorter exposure
  } else {
    light_ = light;
  }
  const double whole = duration_s_ + readout_s_;
  const auto spans = static_cast<int>(std::clamp(std::ceil(whole / 0.5e-3), 8.0, 2000.0));
  first_s_ = middle_s - whole / 2;
  spacing_s_ = whole / spans;
  poses_.reserve(static_cast<std::size_t>(spans) + 1);
  for (int i = 0; i <= spans; ++i) poses_.push_back(motion.at(first_s_ + i * spacing_s_));
}

Pose Exposure::pose(double t) const {
  const double place = std::clamp((t - first_s_) / spacing_s_, 0.0, static_cast<double>(poses_.size() - 1));
  const auto left = std::min(static_cast<std::size_t>(place), poses_.size() - 2);
  return between(poses_[left], poses_[left + 1], place - static_cast<double>(left));
}

}  // namespace relock::simulator
