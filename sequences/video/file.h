#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "core/geometry.h"

struct AVFormatContext;
struct AVPacket;
struct AVStream;

namespace relock {

/// How a player turns a stored picture before it shows it: first transposed, then mirrored.
struct Turn {
  bool transposed = false;
  bool mirrored_x = false;
  bool mirrored_y = false;
};
/// Its size after the turn, px.
Size turned(Size stored, const Turn& turn);

/// A video file opened for reading, and the one stream of it that is looked at: the container's default, else
/// the best. Nothing but local files is ever opened, whatever a playlist in the file may ask for.
class VideoFile {
 public:
  /// Throws Error when the file is empty, no video, holds no stream of pictures, or has them in a coding that
  /// the installed libav cannot decode.
  explicit VideoFile(const std::filesystem::path& path);

  const std::string& name() const { return name_; }
  const AVStream& stream() const;
  /// Of every picture as a player shows it, px.
  Size picture_size() const;
  Turn turn() const;
  /// Whether the format keeps times at all; a bare stream of pictures does not.
  bool keeps_times() const;
  /// Whole nanoseconds of a time that is counted in units of the stream.
  std::int64_t nanoseconds(std::int64_t ticks) const;

  /// The least time at which the last picture ends by the file's header; nothing if it does not say, or holds
  /// other streams, which may be longer.
  std::optional<std::int64_t> stated_end_ns() const;

  /// The stream's next packet, valid until the next call; null at the end.
  const AVPacket* read();
  /// Whether the end that `read` came to is not one that the container foresaw.
  bool cut_off() const { return cut_off_; }

 private:
  struct CloseFormat {
    void operator()(AVFormatContext* format) const;
  };
  struct FreePacket {
    void operator()(AVPacket* packet) const;
  };

  std::string name_;
  std::unique_ptr<AVFormatContext, CloseFormat> format_;
  std::unique_ptr<AVPacket, FreePacket> packet_;
  int stream_ = -1;
  bool cut_off_ = false;
};

}  // namespace relock
