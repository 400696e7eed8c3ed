#pragma once

#include <cmath>
#include <opencv2/core/mat.hpp>
#include <opencv2/imgproc.hpp>

#include "core/error.h"
#include "core/image.h"
#include "core/picture.h"

// Between relock's types and OpenCV's: the one home of the half pixel. All of it is in this header, so that a
// plug-in that uses OpenCV has it without linking relock.

namespace relock {

/// A Mat header over the same pixels: for functions that do not write. Trackers get a copy instead.
inline cv::Mat read_only_mat(const Image& image) {
  if (image.empty()) return {};
  const int type = image.format() == PixelFormat::gray8 ? CV_8UC1 : CV_8UC3;
  // cv::Mat has no read-only view; whoever calls this promises not to write.
  auto* pixels = const_cast<std::uint8_t*>(image.row(0));
  return cv::Mat(image.size().height, image.size().width, type, pixels, image.stride());
}

/// A view of a Mat of type CV_8UC1 or CV_8UC3, valid as long as its pixels. Throws Error on another type.
inline Image view(const cv::Mat& mat) {
  if (mat.empty()) return {};
  if (mat.type() != CV_8UC1 && mat.type() != CV_8UC3)
    throw Error("a picture must have one or three channels of 8 bits");
  const auto format = mat.type() == CV_8UC1 ? PixelFormat::gray8 : PixelFormat::bgr8;
  return Image(mat.ptr(), Size{mat.cols, mat.rows}, format, mat.step[0]);
}

inline Picture::Picture(const cv::Mat& mat) : Picture(relock::view(mat)) {}

/// The picture as grey, one byte a pixel: the same pixels if it is grey already, else converted into
/// `buffer`.
inline cv::Mat gray_of(const Image& image, cv::Mat& buffer) {
  const cv::Mat mat = read_only_mat(image);
  if (image.format() == PixelFormat::gray8) return mat;
  cv::cvtColor(mat, buffer, cv::COLOR_BGR2GRAY);
  return buffer;
}

/// A copy of the picture as BGR in `buffer`, continuous, for functions that may write.
inline const cv::Mat& bgr_copy(const Image& image, cv::Mat& buffer) {
  const cv::Mat mat = read_only_mat(image);
  if (image.format() == PixelFormat::gray8) {
    cv::cvtColor(mat, buffer, cv::COLOR_GRAY2BGR);
  } else {
    mat.copyTo(buffer);
  }
  return buffer;
}

/// The integer rectangle nearest to the box.
inline cv::Rect rounded_rect(const Box& box) {
  const int left = static_cast<int>(std::lround(box.x + 0.5));
  const int top = static_cast<int>(std::lround(box.y + 0.5));
  return {left, top, static_cast<int>(std::lround(box.width)), static_cast<int>(std::lround(box.height))};
}
inline Box box_of(const cv::Rect& rect) {
  return {rect.x - 0.5, rect.y - 0.5, static_cast<double>(rect.width), static_cast<double>(rect.height)};
}

/// The same box without rounding: the pixels 10 to 29 are the rectangle {10, …, 20, …} and x 9.5 to 29.5.
inline cv::Rect2d sub_pixel_rect(const Box& box) { return {box.x + 0.5, box.y + 0.5, box.width, box.height}; }
inline Box sub_pixel_box(const cv::Rect2d& rect) {
  return {rect.x - 0.5, rect.y - 0.5, rect.width, rect.height};
}

}  // namespace relock
