#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>

#include "core/sighting.h"

namespace relock {

/// A copy of the picture (CV_8UC1 or CV_8UC3) in colour with what was seen in it drawn on it: outlines, crosses at the
/// centres, and the codes, or the confidences of those without. Lines and letters grow with the picture.
cv::Mat drawn(const cv::Mat& picture, const Sightings& sightings);

/// Writes a picture whole or not at all, as its name's ending says. Throws Error when it cannot.
void write_picture(const std::filesystem::path& path, const cv::Mat& picture);

}  // namespace relock
