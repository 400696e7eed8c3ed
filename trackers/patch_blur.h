#pragma once

#include "core/compose.h"

namespace relock {

/// Tells blur by comparing a target with its first look. The box of the first call is the sharp look (nothing is
/// told of it); it is blurred along 12 directions by 8 lengths from 0.1 to 0.8 of its size, and the copy
/// that correlates best with a later picture, shifted a little, tells that one's blur. Nothing is told where no copy
/// is like it, or none is more like it than the sharp look. Coarse: a step is 15 degrees and 0.1 of the size; what a
/// detector or a tracker says of blur is better.
BlurMeter patch_blur();

}  // namespace relock
