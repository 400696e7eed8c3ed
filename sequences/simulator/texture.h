#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

namespace relock::simulator {

/// A picture in linear light as the renderer samples it: CV_32FC4 (blue, green, red in [0, 1], premultiplied by
/// the fourth, coverage in [0, 1]), and the same at half the size again and again, by area averaging.
struct Texture {
  std::vector<cv::Mat> levels;  ///< full size first; never empty

  int width() const { return levels.front().cols; }
  int height() const { return levels.front().rows; }
};

/// From 8 bits a channel in sRGB coding, CV_8UC1, CV_8UC3 or CV_8UC4 (with straight, not premultiplied,
/// coverage). `light`: one factor in linear light for each pixel, CV_32FC1 of any size (stretched), or empty.
Texture make_texture(const cv::Mat& picture, const cv::Mat& light = {});

}  // namespace relock::simulator
