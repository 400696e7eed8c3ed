#pragma once

#include <cstdint>

#include "core/recording.h"
#include "eval/trajectory.h"

namespace relock {

/// A small recording and what some method said of it.
struct Case {
  Recording recording;
  Trajectory trajectory;
};

/// Draws an adversarial one: gaps, pauses and labels that come and go; targets that cross, coincide and share
/// codes; methods that follow, drift off, freeze, shout, fall silent, mistake codes, are started anew or
/// crash; places on a coarse grid, so that distances and gates are met exactly. Same seed, same case.
Case random_case(std::uint64_t seed);

}  // namespace relock
