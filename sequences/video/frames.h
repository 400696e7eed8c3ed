#pragma once

#include <filesystem>
#include <memory>

#include "core/frame_source.h"
#include "sequences/video/index.h"

namespace relock {

/// The frames of a video file that `index` lists, at its times. A frame is decoded when its picture or that of
/// a later one is asked for, and its pixels are converted only when its own is. Throws Error as VideoFile does.
std::unique_ptr<FrameSource> open_video(const std::filesystem::path& path,
                                        std::shared_ptr<const VideoIndex> index);

}  // namespace relock
