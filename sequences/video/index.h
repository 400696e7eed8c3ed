#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/time.h"

namespace relock {

/// Which frames a video file holds, and when they were captured.
struct VideoIndex {
  std::vector<std::int64_t> keys;  ///< of each frame, rising: its time in units of the stream, or its rank
  bool by_rank = false;            ///< the keys are ranks, because the times are none
  std::vector<Time> captured;      ///< presentation times as the container keeps them; empty if by_rank
  std::string untimed;             ///< why the times are none, as the end of a sentence; empty if they are
  bool cut_off = false;            ///< the file ends before it should; its last frame may be broken
};

/// Lists the frames of a video file without decoding them, from the packets' presentation times. Where packets
/// and frames may not be one to one, it decodes the whole file instead: when a packet has no time or the time
/// of another, is damaged, or comes before the first key frame; when pictures may come as two fields; and for
/// codings that have packets without a picture. A frame that is lost or damaged is listed at the time of its
/// packet, so that it is missed when its turn comes.
/// Throws Error as VideoFile does, and when the file holds not a single frame.
VideoIndex index_video(const std::filesystem::path& path);

}  // namespace relock
