#pragma once

#include "core/time.h"

// Constants of docs/metrics.md that more than one part of the evaluator needs.

namespace relock {

/// A capture interval over this is a pause: no visible time, and labels stop (section 2).
constexpr Duration kPause = std::chrono::seconds(5);
/// Labels stop when there is more than this between two labelled frames with an unlabelled one between
/// (section 4).
constexpr Duration kLabelsStop = std::chrono::milliseconds(500);
/// Oldest Hit that still counts as available: A (section 6).
constexpr Duration kFreshFix = std::chrono::milliseconds(100);

}  // namespace relock
