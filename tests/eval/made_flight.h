#pragma once

#include <string>

#include "core/frame_source.h"
#include "core/recording.h"

namespace relock {

/// A recording of one target, 40 px, that moves 1 px a frame to the right, one frame a letter at 30 Hz:
/// v visible, a absent, ? unlabelled, o visible but largely occluded.
Recording made_flight(const std::string& letters);

/// Its frames: blank pictures of 640x360. `unreadable_from`: the first one that cannot be read, or -1.
class MadeFrames final : public FrameSource {
 public:
  explicit MadeFrames(const Recording& recording, FrameIndex unreadable_from = -1);
  std::span<const Time> captured() const override { return recording_.captured; }
  Size picture_size() const override { return recording_.picture; }
  std::optional<FrameStamp> next() override;
  Image image() override;

 private:
  const Recording& recording_;
  FrameIndex unreadable_from_;
  FrameIndex at_ = -1;
  std::vector<std::uint8_t> pixels_;
};

}  // namespace relock
