#pragma once

#include <opencv2/core/mat.hpp>

#include "core/geometry.h"

namespace relock::simulator {

/// What a picture becomes while it moves evenly and straight by `way` (px; both signs are the same): each pixel
/// is the mean along a line of that length and direction through it. CV_32FC1, without `margin` pixels on
/// each side, so that nothing outside the picture is ever asked for.
///
/// The same as filtering with blur_kernel (core/blur.h), up to interpolation: along the line it is linear and
/// exact; across it is of third degree (Keys 1981), which adds no width, where the kernel's bilinear shares add
/// up to 1/4 px^2. The time taken does not depend on the length: rows are shifted until the line is upright, and a sum
/// runs down them. Every step is plain arithmetic of `float`, so the bytes are the same on every machine.
///
/// `bin`: each pixel of the result is the mean of that many squared. Throws Error when `margin` is less than
/// smear_margin(way), or when what it leaves is nothing or not whole bins.
cv::Mat1f smeared(const cv::Mat1f& picture, Vec2 way, int margin, int bin = 1);

/// How far outside a pixel the line and its interpolation reach, px.
int smear_margin(Vec2 way);

}  // namespace relock::simulator
