#pragma once

#include <vector>

#include "cli/catalogue.h"
#include "cli/jump/jumps.h"
#include "sequences/open.h"

namespace relock::jumps {

/// What became of one jump.
enum class Outcome : std::uint8_t {
  not_held,  ///< the target was not held before the gap: nothing is known of the jump
  held,
  declared,  ///< lost, and nothing was said
  silent,    ///< lost, and a wrong place was said
  failed,    ///< the method threw, crashed or hung: lost
};
bool lost(Outcome outcome);

/// What is tried: each method, and the jumps of each recording.
struct Trial {
  std::vector<ChosenMethod> methods;
  std::vector<Sequence> sequences;
  std::vector<std::vector<Jump>> jumps;  ///< of each sequence, in order of frames
  JumpTest test;
  Clock clock = Clock::kept;
  std::uint64_t seed = 1;  ///< of the methods
};

/// By method, sequence and jump.
using Outcomes = std::vector<std::vector<std::vector<Outcome>>>;

/// Tries every jump by every method, each with a new object; a method and a sequence in a process of its own, `jobs` at
/// a time, so that one that crashes or hangs takes nothing else down. Shows progress on a terminal. The outcomes are the
/// same for any number of jobs. Throws Error when a recording cannot be read.
Outcomes try_all(const Trial& trial, int jobs);

}  // namespace relock::jumps
