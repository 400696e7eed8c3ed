#pragma once

#include "core/registry.h"

namespace relock {

/// Adds the trackers that come with relock; programs add their own beside them.
void add_builtin_trackers(Registry<TrackerEntry>& registry);

}  // namespace relock
