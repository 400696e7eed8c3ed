#pragma once

#include <string_view>

#include "core/image.h"

namespace relock {

/// What a library tracker can be started on without harm: a box of at least 10 x 10 px, half of it or more in
/// the picture, and not the whole picture. Beyond these limits OpenCV's trackers throw, run for minutes or
/// crash. Returns the box rounded to whole pixels and clipped to the picture. Throws Error naming `tracker`,
/// the box and the limit that it breaks.
Box startable_box(std::string_view tracker, const Image& picture, const Box& box);

}  // namespace relock
