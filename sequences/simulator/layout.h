#pragma once

#include <vector>

#include "sequences/simulator/room.h"
#include "sequences/simulator/scene.h"

namespace relock::simulator {

/// The sheets of the targets where the arrangement says, without texture. Throws Error on no target, more than
/// there are places for, and sheets that overlap or do not fit.
std::vector<Surface> sheets_of(const ScenePlan& plan, const std::vector<PrintedTarget>& targets,
                               const Room& room);

/// The box behind its sheets and the post that it stands on, in an order in which each hides those before it
/// from wherever it is seen.
std::vector<Surface> box_of(const ScenePlan& plan, const Room& room);

/// The middle of a surface, m.
inline Eigen::Vector3d middle_of(const Surface& s) { return s.corner + 0.5 * (s.right + s.down); }

}  // namespace relock::simulator
