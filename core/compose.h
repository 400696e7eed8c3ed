#pragma once

#include <functional>
#include <memory>

#include "core/detector.h"
#include "core/method.h"
#include "core/tracker.h"

// Methods made of detectors and trackers. A new way to combine them is a new builder, not a new flag.

namespace relock {

/// Detection in every frame, on its own; takes no boxes.
std::unique_ptr<Method> detect_every_frame(std::unique_ptr<Detector> detector);

/// A new tracker; `start_number` counts the starts of a run from 0, so that each may draw its own random
/// numbers.
using TrackerFactory = std::function<std::unique_ptr<Tracker>(std::uint64_t start_number)>;

/// One tracker for each target, from the given box, each start with a new tracker. Its sightings carry their
/// target's id.
std::unique_ptr<Method> track_from_box(TrackerFactory make_tracker);

}  // namespace relock
