#pragma once

#include <vector>

#include "cli/bench/bench.h"

namespace relock::bench {

/// Recognition on violent simulated flights, whose exposures bend and speed up, through a rolling shutter of 20 ms: in
/// percentage points over that on stills in clutter of the same size, tilt and length of blur, whose blur is straight and
/// even. Frames on which the marker is whole in the picture.
std::vector<Measured> measure_violent(Bench& bench);

}  // namespace relock::bench
