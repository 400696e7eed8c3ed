#pragma once

#include "core/image.h"
#include "core/time.h"

namespace relock {

/// What a method may see of a recording: one picture, when it was captured, and its rank.
struct Frame {
  FrameIndex index = 0;  ///< rank among the recorded frames; frames that were dropped leave holes
  Time captured;
  Image image;  ///< its pixels live until the next frame is asked for
};

/// A recorded frame before its pixels are decoded.
struct FrameStamp {
  FrameIndex index = 0;
  Time captured;
};

}  // namespace relock
