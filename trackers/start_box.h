#pragma once

#include <opencv2/core/types.hpp>
#include <string_view>

#include "core/image.h"

namespace relock {

/// What a tracker can be started on without harm: a box that in whole pixels has at least 10 x 10 px, half of
/// it or more in the picture, and is not the whole picture. Beyond these limits OpenCV's trackers throw, run
/// for minutes or crash. Returns the part of the box that lies in the picture, not rounded. Throws Error
/// naming `tracker`, the box and the limit that it breaks.
Box startable_box(std::string_view tracker, const Image& picture, const Box& box);

/// The whole pixels nearest to the box, within a picture of this size.
cv::Rect whole_pixels(const Box& box, Size picture);

}  // namespace relock
