#include "detectors/ring_paper/components.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace relock::ring_paper {
namespace {

void keep_largest(std::vector<Component>& parts, std::size_t most) {
  if (parts.size() <= most) return;
  const auto larger = [](const Component& a, const Component& b) {
    return a.area != b.area ? a.area > b.area : a.label < b.label;
  };
  std::nth_element(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(most), parts.end(), larger);
  parts.resize(most);
  std::sort(parts.begin(), parts.end(), [](const auto& a, const auto& b) { return a.label < b.label; });
}

void add_moments(const cv::Mat1i& labels, Component& part) {
  for (int y = part.box.y; y < part.box.y + part.box.height; ++y)
    for (int x = part.box.x; x < part.box.x + part.box.width; ++x) {
      if (labels(y, x) != part.label) continue;
      const Vec2 d = Vec2{static_cast<double>(x), static_cast<double>(y)} - part.centroid;
      part.xx += d.x * d.x, part.xy += d.x * d.y, part.yy += d.y * d.y;
    }
}

}  // namespace

Components connected_components(const cv::Mat1b& binary, int least_area, int most) {
  Components found;
  cv::Mat statistics, centroids;
  const int count = cv::connectedComponentsWithStats(binary, found.labels, statistics, centroids, 8, CV_32S);
  for (int label = 1; label < count; ++label) {  // 0 is the rest
    const int* s = statistics.ptr<int>(label);
    const double* c = centroids.ptr<double>(label);
    if (s[cv::CC_STAT_AREA] < least_area) continue;
    found.parts.push_back(
        {.label = label,
         .area = s[cv::CC_STAT_AREA],
         .box = {s[cv::CC_STAT_LEFT], s[cv::CC_STAT_TOP], s[cv::CC_STAT_WIDTH], s[cv::CC_STAT_HEIGHT]},
         .centroid = {c[0], c[1]}});
  }
  keep_largest(found.parts, static_cast<std::size_t>(most));
  for (Component& part : found.parts) add_moments(found.labels, part);
  return found;
}

}  // namespace relock::ring_paper
