#pragma once

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "core/printed_target.h"

namespace relock {

/// A disc of one grey level on a sheet of another, with soft edges.
inline PrintedTarget disc(double inside = 20, double outside = 128, int side = 600) {
  PrintedTarget target{.name = "disc:1", .code = Code{"disc", "1"}, .outline = PrintedOutline::circle};
  cv::Mat1b picture(side, side);
  const double radius = side * target.size_m / target.sheet_m / 2, middle = (side - 1) / 2.0;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const double covered = std::clamp(radius - std::hypot(x - middle, y - middle) + 0.5, 0.0, 1.0);
      picture(y, x) = cv::saturate_cast<std::uint8_t>(outside + covered * (inside - outside));
    }
  target.picture = picture;
  return target;
}

/// A square of four quarters, none like another.
inline PrintedTarget quarters() {
  PrintedTarget target{.name = "quarters"};
  cv::Mat1b picture(64, 64, static_cast<std::uint8_t>(255));
  for (int y = 8; y < 56; ++y)
    for (int x = 8; x < 56; ++x)
      picture(y, x) = static_cast<std::uint8_t>(10 + 60 * (x / 32) + 120 * (y / 32));
  target.picture = picture;
  return target;
}

}  // namespace relock
