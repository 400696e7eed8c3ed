#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>

namespace relock {

/// Decodes the bytes of a picture file (JPEG, PNG, …) to CV_8UC1 or CV_8UC3 (BGR). Throws Error, without saying
/// which, when they are none or end too early.
cv::Mat decode_picture(std::span<const std::uint8_t> bytes);

}  // namespace relock
