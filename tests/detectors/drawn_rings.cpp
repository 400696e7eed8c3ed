#include "tests/detectors/drawn_rings.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/blur.h"
#include "core/random.h"

namespace relock {

void draw_rings(cv::Mat1b& picture, const RingMarker& marker, Vec2 centre, double diameter) {
  constexpr int kParts = 3;  // of a pixel, in each direction
  const double sheet = marker.geometry.sheet_radius();
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 0; x < picture.cols; ++x) {
      if (std::hypot(x - centre.x, y - centre.y) > sheet * diameter / 2 + 1) continue;
      double sum = 0;
      for (int part = 0; part < kParts * kParts; ++part) {
        const double dx = x + (part % kParts + 0.5) / kParts - 0.5 - centre.x;
        const double dy = y + (part / kParts + 0.5) / kParts - 0.5 - centre.y;
        const double rho = 2 * std::hypot(dx, dy) / diameter;
        sum += rho < sheet ? 255 * reflectance(marker, rho) : picture(y, x);
      }
      picture(y, x) = cv::saturate_cast<std::uint8_t>(sum / (kParts * kParts));
    }
}

cv::Mat1b blurred(const cv::Mat1b& picture, const BlurEstimate& blur) {
  cv::Mat1b moved;
  cv::filter2D(picture, moved, CV_8U, blur_kernel(blur), {-1, -1}, 0, cv::BORDER_REPLICATE);
  return moved;
}

void add_noise(cv::Mat1b& picture, double deviation, std::uint64_t seed) {
  Random random(seed);
  for (std::uint8_t& level : picture)
    level = cv::saturate_cast<std::uint8_t>(level + deviation * random.normal());
}

cv::Mat1b blurred_rings(const std::string& bits, double diameter, const BlurEstimate& blur, int side,
                        std::uint64_t seed) {
  cv::Mat1b picture(side, side, std::uint8_t{128});
  const RingGeometry geometry = ring_geometry("paper", static_cast<int>(bits.size()));
  draw_rings(picture, {geometry, bits}, {side / 2.0 - 0.3, side / 2.0 + 0.2}, diameter);
  picture = blurred(picture, blur);
  add_noise(picture, 2, seed);
  return picture;
}

}  // namespace relock
