#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>

namespace relock {

/// Decodes the bytes of a picture file (JPEG, PNG, …) to CV_8UC1 or CV_8UC3 (BGR), turned as its Exif says. Of 16
/// bits the nearest of 256 levels is kept; transparency is ignored. Throws Error, without saying which, when they are
/// none, end too early, or hold pixels of another depth.
cv::Mat decode_picture(std::span<const std::uint8_t> bytes);

}  // namespace relock
