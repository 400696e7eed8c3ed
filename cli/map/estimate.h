#pragma once

#include <string>

#include "cli/map/sweep.h"
#include "cli/program.h"

namespace relock::maps {

/// What a sweep will make and about how long that takes: one short flight of the middle row is flown and shown
/// to every method, in a temporary folder.
std::string estimate_of(const SweepPlan& plan, const Methods& methods, int jobs);

}  // namespace relock::maps
