#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <set>

#include "sequences/video/file.h"

struct AVCodecContext;
struct AVFrame;

namespace relock {

/// One frame as the decoder gives it.
struct DecodedFrame {
  const AVFrame* frame = nullptr;     ///< valid until the next one is asked for
  std::int64_t rank = 0;              ///< from 0; packets of which no frame came leave holes
  std::optional<std::int64_t> ticks;  ///< presentation time in units of the stream
  Size stored;                        ///< before any turn, px
  bool whole = true;                  ///< nothing in it was lost, neither its own data nor what it refers to
};

/// Decodes a video file from its first frame to its last, in the order in which they are shown. One thread:
/// the same frames on every machine.
class VideoDecoder {
 public:
  /// Throws Error as VideoFile does.
  explicit VideoDecoder(const std::filesystem::path& path);

  /// Nothing at the end.
  std::optional<DecodedFrame> next();

  const VideoFile& file() const { return file_; }
  /// Presentation times of what was lost or damaged so far.
  const std::set<std::int64_t>& damaged() const { return damaged_; }
  /// Frames and holes so far.
  std::int64_t ranks() const { return ranks_; }

 private:
  struct FreeCodec {
    void operator()(AVCodecContext* codec) const;
  };
  struct FreeFrame {
    void operator()(AVFrame* frame) const;
  };

  using FramePointer = std::unique_ptr<AVFrame, FreeFrame>;
  struct Held {
    FramePointer frame;
    DecodedFrame decoded;
  };

  /// Gives the decoder one more packet, or tells it that there are no more.
  void feed();
  /// A packet of which no frame comes.
  void lose(std::int64_t ticks);
  /// Holds one more frame; false at the end.
  bool hold();
  void note_damage(DecodedFrame& decoded, const AVFrame& frame);

  VideoFile file_;
  std::unique_ptr<AVCodecContext, FreeCodec> codec_;
  std::deque<Held> held_;  // the front is the frame given last
  std::set<std::int64_t> damaged_;
  std::int64_t ranks_ = 0;
  // Damage spreads from frame to frame until a key frame starts afresh.
  std::int64_t afresh_ = std::numeric_limits<std::int64_t>::min();  // time of the last whole key frame
  bool tainted_ = false;                                            // by damage that has no time
};

}  // namespace relock
