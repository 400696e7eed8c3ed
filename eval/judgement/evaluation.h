#pragma once

#include <vector>

#include "eval/judgement/states.h"

namespace relock {

/// All verdicts, states and events of one trajectory.
struct Evaluation {
  Gate gate;
  std::vector<TargetTimeline> targets;
  std::vector<int> spurious;  ///< sightings of nothing, of every recorded frame
  std::vector<int> ignored;   ///< sightings of what is not judged there, of every recorded frame
};

/// Judges every frame and follows every target (metrics.md sections 3 and 4). Time is linear in frames.
/// Throws Error when the trajectory does not fit the recording.
Evaluation evaluate(const Recording& recording, const Trajectory& trajectory, const Gate& gate = {});

/// What a LockWatch is shown of one target on one frame.
Observation observation(const Recording& recording, std::size_t frame, std::size_t target,
                        const Judgement& judgement, const Sightings& sightings);

}  // namespace relock
