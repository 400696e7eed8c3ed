#pragma once

#include <optional>
#include <span>
#include <string>

#include "core/frame.h"

namespace relock {

/// A recording, frame by frame. Pixels are decoded only when asked for, and held for one frame at a time, so
/// memory does not grow with length (but for each picture's capture time and name).
class FrameSource {
 public:
  virtual ~FrameSource() = default;

  /// Capture times of all recorded frames, strictly increasing.
  virtual std::span<const Time> captured() const = 0;
  /// Size of every picture, px.
  virtual Size picture_size() const = 0;

  /// Moves on to the next recorded frame, the first at the first call; nothing at the end.
  virtual std::optional<FrameStamp> next() = 0;
  /// The current frame's pixels, valid until the next call of `next`.
  /// Throws Error naming the file if they cannot be read or have another size than the others.
  virtual Image image() = 0;
};

}  // namespace relock
