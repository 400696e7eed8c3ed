#include "core/opencv.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/error.h"

namespace relock {

cv::Mat read_only_mat(const Image& image) {
  if (image.empty()) return {};
  const int type = image.format() == PixelFormat::gray8 ? CV_8UC1 : CV_8UC3;
  // cv::Mat has no read-only view; whoever calls this promises not to write.
  auto* pixels = const_cast<std::uint8_t*>(image.row(0));
  return cv::Mat(image.size().height, image.size().width, type, pixels, image.stride());
}

Image view(const cv::Mat& mat) {
  if (mat.empty()) return {};
  if (mat.type() != CV_8UC1 && mat.type() != CV_8UC3)
    throw Error("a picture must have one or three channels of 8 bits");
  const auto format = mat.type() == CV_8UC1 ? PixelFormat::gray8 : PixelFormat::bgr8;
  return Image(mat.ptr(), Size{mat.cols, mat.rows}, format, mat.step[0]);
}

cv::Mat gray_of(const Image& image, cv::Mat& buffer) {
  const cv::Mat mat = read_only_mat(image);
  if (image.format() == PixelFormat::gray8) return mat;
  cv::cvtColor(mat, buffer, cv::COLOR_BGR2GRAY);
  return buffer;
}

const cv::Mat& bgr_copy(const Image& image, cv::Mat& buffer) {
  const cv::Mat mat = read_only_mat(image);
  if (image.format() == PixelFormat::gray8) {
    cv::cvtColor(mat, buffer, cv::COLOR_GRAY2BGR);
  } else {
    mat.copyTo(buffer);
  }
  return buffer;
}

cv::Rect rounded_rect(const Box& box) {
  const int left = static_cast<int>(std::lround(box.x + 0.5));
  const int top = static_cast<int>(std::lround(box.y + 0.5));
  return {left, top, static_cast<int>(std::lround(box.width)), static_cast<int>(std::lround(box.height))};
}

Box box_of(const cv::Rect& rect) {
  return {rect.x - 0.5, rect.y - 0.5, static_cast<double>(rect.width), static_cast<double>(rect.height)};
}

cv::Rect2d sub_pixel_rect(const Box& box) { return {box.x + 0.5, box.y + 0.5, box.width, box.height}; }

Box sub_pixel_box(const cv::Rect2d& rect) { return {rect.x - 0.5, rect.y - 0.5, rect.width, rect.height}; }

}  // namespace relock
