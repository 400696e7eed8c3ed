#pragma once

#include <memory>

#include "core/method.h"
#include "core/recording.h"

// The two yardsticks that are no method: they mark the ends of the scale in every comparison. (`still` and
// `linear` are trackers: trackers/yardsticks.h.)

namespace relock {

/// Never answers.
std::unique_ptr<Method> mute();

/// Always answers with the truth, which no method may see; `recording` must outlive it. It answers with the
/// centre that truth knows best, the outline, and the code.
std::unique_ptr<Method> oracle(const Recording& recording);

}  // namespace relock
