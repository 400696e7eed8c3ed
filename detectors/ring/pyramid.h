#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <opencv2/core/mat.hpp>

#include "core/geometry.h"

namespace relock::ring {

/// A grey picture in full, half and quarter size: every pixel of a level is the mean of those it covers.
struct Pyramid {
  static constexpr std::size_t kLevels = 3;
  std::array<cv::Mat, kLevels> level;  ///< CV_8UC1; level[0] shares its pixels with the picture given

  /// `picture`: CV_8UC1, whose pixels must stay as long as the pyramid is used. Buffers are kept from call to
  /// call.
  void build(const cv::Mat& picture);

  const cv::Mat& full() const { return level[0]; }
  const cv::Mat& half() const { return level[1]; }
  const cv::Mat& quarter() const { return level[2]; }
};

/// A point of the level `level` in px of the full picture: pixel centres are at integers in both.
inline Vec2 in_full_picture(Vec2 point, std::size_t level) {
  const double scale = std::ldexp(1.0, static_cast<int>(level));
  return {(point.x + 0.5) * scale - 0.5, (point.y + 0.5) * scale - 0.5};
}

}  // namespace relock::ring
