#pragma once

#include <vector>

#include "cli/bench/bench.h"

namespace relock::bench {

/// Time of the detector over time of `aruco`, which comes as it is, on the same pictures of clutter with a marker,
/// in turn, on one core; medians over the pictures. Not the same from run to run.
std::vector<Measured> measure_times(Bench& bench);

}  // namespace relock::bench
