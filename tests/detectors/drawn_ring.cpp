#include "tests/detectors/drawn_ring.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace relock {
namespace {

constexpr int kPlaces = 4;  // of a pixel, in each direction
constexpr double kMoment_px = 1;
constexpr int kTable = 2000;  // radii, each 1/1000 of the marker's

/// reflectance(), looked up: it is asked for millions of times.
std::vector<double> light_along_radius(const RingMarker& marker) {
  std::vector<double> light;
  for (int i = 0; i < kTable; ++i) light.push_back(reflectance(marker, (i + 0.5) / 1000));
  return light;
}

}  // namespace

void draw(cv::Mat1b& picture, const RingMarker& marker, const DrawnRing& drawn) {
  const std::vector<double> light = light_along_radius(marker);
  const double sheet = marker.geometry.sheet_radius();
  const int moments = std::max(1, static_cast<int>(norm(drawn.blur) / kMoment_px));
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 0; x < picture.cols; ++x) {
      const Vec2 off = Vec2{static_cast<double>(x), static_cast<double>(y)} - drawn.centre;
      if (norm(off) > sheet * drawn.radius_px + norm(drawn.blur) / 2 + 1) continue;
      double sum = 0;
      for (int moment = 0; moment < moments; ++moment) {
        const Vec2 moved = off - ((moment + 0.5) / moments - 0.5) * drawn.blur;
        for (int place = 0; place < kPlaces * kPlaces; ++place) {
          const Vec2 at{moved.x + (place % kPlaces + 0.5) / kPlaces - 0.5,
                        moved.y + (place / kPlaces + 0.5) / kPlaces - 0.5};
          const double rho = norm(at) / drawn.radius_px;
          sum += rho < sheet
                     ? drawn.black + (drawn.white - drawn.black) * light[static_cast<std::size_t>(rho * 1000)]
                     : picture(y, x);
        }
      }
      picture(y, x) = static_cast<std::uint8_t>(std::lround(sum / (moments * kPlaces * kPlaces)));
    }
}

}  // namespace relock
