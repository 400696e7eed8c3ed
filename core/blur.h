#pragma once

#include <opencv2/core/mat.hpp>

#include "core/sighting.h"

namespace relock {

/// The longest motion that a kernel is made for, px.
constexpr double kLongestBlur_px = 10000;

/// The kernel of straight, even motion over the exposure: a line of `blur`'s length and direction (from +x
/// towards +y) through the middle of the kernel. CV_32FC1 of odd sides, of sum 1, the same when turned by half
/// a turn: so cv::filter2D moves nothing, and what was exposed evenly from -length/2 to +length/2 keeps its place.
///
/// Each point of the line is shared bilinearly among the four pixels around it, and that is integrated exactly:
/// filtering with it is averaging copies of the picture that are shifted along the line by bilinear
/// interpolation, without end many of them. The mean is the middle. The covariance is that of the line,
/// length^2 / 12 along its direction, and on x and y apart the mean over the line of f (1 - f), the share of the
/// interpolation, where f is how far a point is behind a pixel centre: 0 for a line along a row of pixels, 1/6
/// for a long slanted one, never over 1/4.
///
/// Length 0: a single 1. Throws Error on a length or direction that is not finite, on a negative length and on
/// one over kLongestBlur_px.
cv::Mat blur_kernel(const BlurEstimate& blur);

}  // namespace relock
