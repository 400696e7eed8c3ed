#pragma once

#include "core/registry.h"

namespace relock {

/// All methods that a program knows by name.
struct Methods {
  Registry<DetectorEntry> detectors;
  Registry<TrackerEntry> trackers;
};

/// Those that relock comes with. Your own come as plug-ins (docs/adding-a-detector.md), or you add them here
/// and hand all of them to `run_program` in a main of your own.
Methods builtin_methods();

/// The relock program with these methods: reads the arguments and does what they say.
/// Returns the exit status: 0; 1 when a method failed (its runs are scored all the same) or a plug-in that
/// --plugin names was left out; 2 when something
/// that was given is at fault, told in one sentence on stderr.
int run_program(int argc, char** argv, const Methods& methods);

}  // namespace relock
