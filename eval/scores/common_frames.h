#pragma once

#include "core/recording.h"
#include "eval/trajectory.h"

namespace relock {

/// The two arms of a paired gap experiment, one method on one recording without and with a drop pattern, on the
/// frames that came in both: the common frames (metrics.md section 7). What is evaluated and scored of it is
/// comparable; arms scored on all their own frames are not, because dropping frames flatters everyone: the
/// rules of loss need three of them.
///
/// Frames keep their places, and one that either arm did not get is Dropped in both. Verdicts and events are
/// then those of a recording of the common frames alone, except that labels stop where they do on all recorded
/// frames.
struct CommonFrames {
  Recording recording;       ///< up to `frames`; its period is that of the common frames, whatever was stated
  Trajectory without, with;  ///< each arm
  std::vector<bool> common;  ///< of each frame of `recording`: delivered in both arms
  bool ends_at_reset = false;  ///< the first reset of any target in either arm ended the pair
};

/// How far two arms can be compared: recorded frames before the first reset of any target in either of them,
/// else all. A reset is a target's second Given frame; its first, the start, may come late in real time.
std::size_t frames_before_reset(const Trajectory& without, const Trajectory& with);

/// The first `frames` of a trajectory.
Trajectory up_to(Trajectory trajectory, std::size_t frames);

/// The trajectory as if only the frames that `delivered` holds true for had come, as long as that is.
Trajectory only(const Trajectory& arm, const std::vector<bool>& delivered);

/// Throws Error when the trajectories are not both of this recording.
CommonFrames common_frames(const Recording& recording, const Trajectory& without, const Trajectory& with);

}  // namespace relock
