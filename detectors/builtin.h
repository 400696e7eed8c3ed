#pragma once

#include "core/registry.h"

namespace relock {

/// Adds the detectors that come with relock; programs add their own beside them.
void add_builtin_detectors(Registry<DetectorEntry>& registry);

}  // namespace relock
