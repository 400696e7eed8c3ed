#pragma once

#include <optional>

#include "eval/judgement/evaluation.h"

namespace relock {

/// What a loss came with (metrics.md section 4): the interval before its first scored frame, from the
/// delivered frame before it, and the target on that frame.
struct Circumstances {
  std::int64_t slots = 1;                ///< of the interval: 1 + the three below; 2 or more are a gap
  std::int64_t slots_recorded = 0;       ///< lost in the recording itself
  std::int64_t slots_injected = 0;       ///< dropped frames
  std::int64_t slots_skipped = 0;        ///< frames for which the method was busy
  std::optional<double> blur_px;         ///< length of the true blur on arrival
  std::optional<double> displacement_d;  ///< of the true centre over the interval, in D
  std::optional<double> border_px;       ///< least distance of the outline from the picture's border
  std::optional<double> tilt_deg;
  std::optional<double> size_px;  ///< D
};

Circumstances circumstances(const Recording& recording, const Trajectory& trajectory, std::size_t target,
                            const Loss& loss);
/// Of the interval that ends at the delivered frame `arrival`, which is not the first.
Circumstances circumstances(const Recording& recording, const Trajectory& trajectory, std::size_t target,
                            FrameIndex arrival);

}  // namespace relock
