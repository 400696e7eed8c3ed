#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "core/frame.h"

namespace relock {

/// A small world for trackers: a textured patch of 32 x 28 px before a textured wall, 160 x 120 px, in
/// colour.
cv::Mat3b patch_at(Vec2 top_left_pixel);
/// The box of that patch.
Box patch_box(Vec2 top_left_pixel);
/// Without the patch.
cv::Mat3b bare_wall();

/// A frame at 30 Hz. The pixels stay the caller's.
Frame frame_of(const cv::Mat& pixels, FrameIndex index);

}  // namespace relock
