#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "core/sighting.h"
#include "core/time.h"

namespace relock {

/// An interval of more nominal periods than this is a gap.
constexpr double kGap = 1.5;

/// What the frames shown so far say of time, and the answers so far of a target's motion (core/compose.h says
/// what for). Velocities are px/s.
class MotionMemory {
 public:
  /// What is known beforehand: the nominal period, else it is estimated; the exposure, else kappa is learned.
  explicit MotionMemory(std::optional<double> period_s = {}, std::optional<double> exposure_s = {});

  /// A frame is shown; every one is told, in order.
  void show(Time captured);
  /// The target was seen at `box` in the frame shown last.
  void see(const Box& box, const std::optional<BlurEstimate>& blur);

  /// Nominal period of the frames before the last one; empty: fewer than three were shown.
  const std::optional<Duration>& period() const { return period_; }
  /// Whether frames are missing before the one shown last.
  bool after_gap() const;
  /// Where it was seen last; empty: never.
  std::optional<Box> last_box() const;
  /// Periods missing between the last answer and the frame shown last; 0 when the target was seen one period ago.
  double missing_periods() const;

  /// From the last two answers over their true times.
  std::optional<Vec2> velocity() const;
  /// Speed and line from the last blur, sign from the last two answers: one velocity. Where they tell no sign (there
  /// are not two, or they moved by less than a quarter of the blur's speed: a tracker may stand still in its first
  /// frame), both; none where the last answer has no blur.
  std::vector<Vec2> velocities_by_blur() const;
  /// Whether the blur told steps from frame to frame at least as well as the answers did, so far; empty: from
  /// too few steps.
  std::optional<bool> blur_tells_better() const;
  /// Displacement over a period in lengths of blur, as learned; empty: from too few frames.
  std::optional<double> learned_kappa() const;
  /// The last box, moved at this velocity to the time of the frame shown last.
  Box moved(Vec2 velocity) const;

 private:
  struct Seen {
    Time at;
    Box box;
    std::optional<BlurEstimate> blur;
  };
  struct StepErrors {
    double by_answers_px, by_blur_px;
  };
  void learn_kappa();
  void compare_speedometers(const Box& box);

  bool period_is_known_;
  std::optional<double> exposure_s_;
  std::deque<Time> shown_;
  std::optional<Duration> period_;
  std::optional<Seen> last_, before_;
  std::deque<double> ratios_;  // displacement a period over length of blur
  std::deque<StepErrors> errors_;
};

}  // namespace relock
