#include "detectors/ring_paper/axis.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/opencv.h"

namespace relock::ring_paper {
namespace {

/// How far one can go from `at` in direction `step` until a wall at `low` or `high`.
void clip(double at, double step, double low, double high, double& back, double& ahead) {
  if (step == 0) return;
  const auto [near, far] = std::minmax({(low - at) / step, (high - at) / step});
  back = std::max(back, near), ahead = std::min(ahead, far);
}

}  // namespace

Axis principal_axis(const std::vector<Component>& parts, const Cluster& cluster) {
  Axis axis;
  double area = 0;
  cv::Rect box;
  for (const std::size_t i : cluster) {
    axis.mean = axis.mean + parts[i].area * parts[i].centroid;
    area += parts[i].area;
    box |= parts[i].box;
  }
  axis.mean = (1 / area) * axis.mean;
  axis.box = box_of(box);
  double xx = 0, xy = 0, yy = 0;
  for (const std::size_t i : cluster) {
    const Vec2 d = parts[i].centroid - axis.mean;
    xx += parts[i].xx + parts[i].area * d.x * d.x;
    xy += parts[i].xy + parts[i].area * d.x * d.y;
    yy += parts[i].yy + parts[i].area * d.y * d.y;
  }
  // The eigenvectors of a symmetric matrix of 2 x 2: half the angle of (xx - yy, 2 xy).
  const double turned = std::atan2(2 * xy, xx - yy) / 2;  // from -90 to 90 degrees
  const double half_sum = (xx + yy) / 2, half_difference = std::hypot((xx - yy) / 2, xy);
  axis.direction = {std::cos(turned), std::sin(turned)};
  axis.reach = std::sqrt((half_sum + half_difference) / area);
  axis.width = std::sqrt(std::max(0.0, half_sum - half_difference) / area);
  return axis;
}

Segment through_box(const Axis& axis, double margin_px) {
  double back = -std::numeric_limits<double>::infinity(), ahead = -back;
  clip(axis.mean.x, axis.direction.x, axis.box.x, axis.box.right(), back, ahead);
  clip(axis.mean.y, axis.direction.y, axis.box.y, axis.box.bottom(), back, ahead);
  return {axis.mean + (back - margin_px) * axis.direction, axis.mean + (ahead + margin_px) * axis.direction};
}

}  // namespace relock::ring_paper
