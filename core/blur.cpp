#include "core/blur.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.h"

namespace relock {
namespace {

/// Where between 0 and 1 the way from the middle to `end` crosses a row or column of pixel centres, with both
/// ends, in order. Between two of these the same four pixels share each point.
std::vector<double> crossings(Vec2 end) {
  std::vector<double> at{0, 1};
  for (const double reach : {std::abs(end.x), std::abs(end.y)})
    for (int i = 1; i < reach; ++i) at.push_back(i / reach);
  std::sort(at.begin(), at.end());
  return at;
}

/// Shares `weight` at `point` bilinearly, and as much at the point opposite.
void share(cv::Mat1d& kernel, Vec2 point, cv::Point cell, double weight) {
  const cv::Point middle(kernel.cols / 2, kernel.rows / 2);
  for (int dy = 0; dy < 2; ++dy)
    for (int dx = 0; dx < 2; ++dx) {
      const cv::Point at = cell + cv::Point(dx, dy);
      const double part = weight * (1 - std::abs(point.x - at.x)) * (1 - std::abs(point.y - at.y));
      if (std::abs(at.x) > middle.x || std::abs(at.y) > middle.y) continue;  // there, the part is nothing
      kernel(middle + at) += part;
      kernel(middle - at) += part;
    }
}

/// Half the line, from the middle to `end`, and the other half as its mirror image. The shares are of second
/// degree between two crossings, and Simpson's rule is exact for those.
void integrate(cv::Mat1d& kernel, Vec2 end) {
  const std::vector<double> at = crossings(end);
  for (std::size_t i = 0; i + 1 < at.size(); ++i) {
    const double length = at[i + 1] - at[i], middle = (at[i] + at[i + 1]) / 2;
    const cv::Point cell(cvFloor(middle * end.x), cvFloor(middle * end.y));
    share(kernel, at[i] * end, cell, length / 12);
    share(kernel, middle * end, cell, length / 3);
    share(kernel, at[i + 1] * end, cell, length / 12);
  }
}

/// Sine and cosine of quarter turns are not quite 0, and what is not quite 0 would need a pixel more.
double without_rounding(double component) { return std::abs(component) < 1e-12 ? 0 : component; }

}  // namespace

cv::Mat blur_kernel(const BlurEstimate& blur) {
  const double length = blur.length_px, direction = blur.direction_rad;
  if (!(length >= 0 && length <= kLongestBlur_px) || !std::isfinite(direction))
    throw Error(fmt::format("a blur of {} px in direction {} is none; its length must be from 0 to {} px",
                            length, direction, kLongestBlur_px));
  const Vec2 end =
      length / 2 * Vec2{without_rounding(std::cos(direction)), without_rounding(std::sin(direction))};
  cv::Mat1d kernel(2 * cvCeil(std::abs(end.y)) + 1, 2 * cvCeil(std::abs(end.x)) + 1, 0.0);
  integrate(kernel, end);
  cv::Mat single;
  kernel.convertTo(single, CV_32F);
  return single;
}

}  // namespace relock
