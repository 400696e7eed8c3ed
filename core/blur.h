#pragma once

#include <opencv2/core/mat.hpp>

#include "core/sighting.h"

namespace relock {

/// The kernel of straight, even motion over the exposure: the line of `blur`'s length and direction through
/// the middle, CV_32FC1 of odd sides, of sum 1. Each point of the line is shared bilinearly among the four pixels around it,
/// and the line is integrated exactly or so finely that it makes no difference; so the kernel's mean is the middle and its
/// covariance that of the line (plus the bilinear share). Length 0: a single 1. Throws Error on a length that is negative or not finite.
cv::Mat blur_kernel(const BlurEstimate& blur);

}  // namespace relock
