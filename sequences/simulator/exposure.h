#pragma once

#include <vector>

#include "sequences/simulator/motion.h"

namespace relock::simulator {

/// How long the shutter is open, and how finely it is imitated.
struct ExposurePlan {
  double time_ms = 12;  ///< in full light
  bool automatic =
      false;  ///< as light falls, longer up to longest_ms, then gain; else the picture gets darker
  double longest_ms = 30;  ///< automatic: no longer than this
  double light = 1;        ///< at the flight's begin, share of full light
  double light_end = 1;    ///< at its end; between, it changes evenly in stops
  double readout_ms = 0;   ///< rolling shutter: from the first row to the last; 0: global
  double step_px = 1;      ///< between two sub-exposures nothing moves farther than about this
  int most_steps = 64;     ///< sub-exposures of a frame; when they do not do, truth.csv tells the step
};

/// Throws Error on values that no camera has, or on an exposure longer than the frame's period.
void check_exposure(const ExposurePlan& plan, double period_s);

/// One frame's exposure as the sensor lives through it. A frame's capture time is the middle of the exposure of its
/// middle row.
class Exposure {
 public:
  Exposure(const ExposurePlan& plan, const Motion& motion, double middle_s, double flight_share);

  double begin_s() const { return middle_s_ - duration_s_ / 2; }
  double middle_s() const { return middle_s_; }
  double end_s() const { return middle_s_ + duration_s_ / 2; }
  double duration_s() const { return duration_s_; }
  /// By how much the camera amplifies.
  double gain() const { return gain_; }
  /// What the scene's light is multiplied by on the sensor, before the gain.
  double light() const { return light_; }
  bool rolling() const { return readout_s_ > 0; }

  /// How much later than the middle row a row is exposed, s; `height`: of the picture, px.
  double delay_s(double row, int height) const { return (row / (height - 1) - 0.5) * readout_s_; }
  /// Where the camera is within a readout or an exposure of this frame.
  Pose pose(double t) const;

 private:
  double middle_s_, duration_s_, readout_s_;
  double gain_ = 1, light_ = 1;
  double first_s_, spacing_s_;
  std::vector<Pose> poses_;  // at even spacing; between two of them the motion is straight to 1e-3 px
};

}  // namespace relock::simulator
