#pragma once

#include <functional>
#include <memory>

#include "core/frame_source.h"

namespace relock {

struct ReversedOptions {
  /// Most memory for decoded pixels, bytes; one picture is always held. Less memory, more passes.
  std::size_t budget_bytes = std::size_t{64} << 20;
};

/// A recording from its last frame to its first, with the same pixels. Frames are counted anew from 0, captured at
/// first + (last - time) (core/time.h, `reflected`).
///
/// Most pictures can only be decoded forward, so they are read a stretch at a time: the last stretch first, each in a
/// pass of its own that `open` begins. Frames whose pixels nobody asks for are not decoded as long as that is
/// possible. A picture that cannot be read is an Error where it is asked for, and none of its neighbours'.
std::unique_ptr<FrameSource> reversed(std::function<std::unique_ptr<FrameSource>()> open,
                                      const ReversedOptions& options = {});

}  // namespace relock
