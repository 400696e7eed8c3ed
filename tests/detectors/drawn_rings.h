#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "core/sighting.h"
#include "detectors/ring_marker.h"

namespace relock {

/// Puts a ring marker on its round sheet into a picture: each pixel is the mean over its area.
void draw_rings(cv::Mat1b& picture, const RingMarker& marker, Vec2 centre, double diameter);

/// A marker of the geometry "paper" alone in the middle of a grey picture, blurred, with noise of deviation 2.
cv::Mat1b blurred_rings(const std::string& bits, double diameter, const BlurEstimate& blur, int side = 320,
                        std::uint64_t seed = 1);

cv::Mat1b blurred(const cv::Mat1b& picture, const BlurEstimate& blur);
void add_noise(cv::Mat1b& picture, double deviation, std::uint64_t seed);

}  // namespace relock
