#pragma once

#include "cli/comparison.h"

namespace relock {

/// Prints, for each target of runs made in real time, what the methods saw of the recording, what a controller had of
/// their answers, and what was lost to slowness and what to failure (eval/in_force.h). Nothing for other runs.
void print_real_time(const ScoredComparison& compared);

}  // namespace relock
