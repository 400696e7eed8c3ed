#pragma once

#include <vector>

#include "core/random.h"
#include "sequences/simulator/light.h"
#include "sequences/simulator/scene.h"

namespace relock::simulator {

/// What passes before one target `hz` times a second, at irregular times, from one second on: things that come
/// down, sweep past 3 to 10 cm before the sheet, in turn hiding all of the target or part of it, and go up again
/// to where they rest, 4 m above it. `size_m`: of the target.
std::vector<Surface> passers_before(const Surface& sheet, double size_m, double hz, const Light& light,
                                    Random random);

}  // namespace relock::simulator
