#pragma once

#include <opencv2/core/mat.hpp>

#include "core/image.h"

// Between relock's types and OpenCV's: the one home of the half pixel.

namespace relock {

/// A Mat header over the same pixels: for functions that do not write. Trackers get a copy instead.
cv::Mat read_only_mat(const Image& image);
/// A view of a Mat of type CV_8UC1 or CV_8UC3, valid as long as its pixels. Throws Error on another type.
Image view(const cv::Mat& mat);

/// The picture as grey, one byte a pixel: the same pixels if it is grey already, else converted into
/// `buffer`.
cv::Mat gray_of(const Image& image, cv::Mat& buffer);
/// A copy of the picture as BGR in `buffer`, continuous, for functions that may write.
const cv::Mat& bgr_copy(const Image& image, cv::Mat& buffer);

/// The integer rectangle nearest to the box.
cv::Rect rounded_rect(const Box& box);
Box box_of(const cv::Rect& rect);
/// The same box without rounding: the pixels 10 to 29 are the rectangle {10, …, 20, …} and x 9.5 to 29.5.
cv::Rect2d sub_pixel_rect(const Box& box);
Box sub_pixel_box(const cv::Rect2d& rect);

}  // namespace relock
