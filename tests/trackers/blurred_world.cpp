#include "tests/trackers/blurred_world.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "core/blur.h"
#include "core/random.h"

namespace relock {
namespace {

constexpr int kColumns = 480, kRows = 320;
constexpr int kReach = 110;  // px that the target may be from the middle, and half of a blur
constexpr double kOpenShare = 5.0 / 6;

cv::Mat1f texture(cv::Size size, std::uint64_t seed, double grain_px, double low, double high) {
  cv::Mat1f noise(size);
  cv::RNG(seed).fill(noise, cv::RNG::UNIFORM, 0, 1);
  cv::GaussianBlur(noise, noise, {0, 0}, grain_px);
  cv::normalize(noise, noise, low, high, cv::NORM_MINMAX);
  return noise;
}

}  // namespace

BlurredWorld::BlurredWorld(std::uint64_t seed)
    : wall_(texture({kColumns + 2 * kReach, kRows + 2 * kReach}, seed, 5, 70, 180)) {
  const cv::Size size{static_cast<int>(kWidth), static_cast<int>(kHeight)};
  const cv::Rect place{{wall_.cols / 2 - size.width / 2, wall_.rows / 2 - size.height / 2}, size};
  texture(size, seed + 1000, 4, 10, 245).copyTo(wall_(place));
}

cv::Mat1b BlurredWorld::picture(Vec2 centre, const BlurEstimate& blur) const {
  const double x = centre.x - (wall_.cols - 1) / 2.0, y = centre.y - (wall_.rows - 1) / 2.0;
  cv::Mat1f seen;
  cv::warpAffine(wall_, seen, cv::Matx23d(1, 0, x, 0, 1, y), {kColumns, kRows}, cv::INTER_LINEAR,
                 cv::BORDER_REFLECT);
  if (blur.length_px > 0) cv::filter2D(seen, seen, -1, blur_kernel(blur), {-1, -1}, 0, cv::BORDER_REFLECT);
  cv::Mat1b grey;
  seen.convertTo(grey, CV_8U);
  return grey;
}

Box BlurredWorld::box(Vec2 centre) {
  return {centre.x - kWidth / 2, centre.y - kHeight / 2, kWidth, kHeight};
}

BlurredPath blurred_path(int frames, double fastest, std::uint64_t seed) {
  constexpr double kKept = 0.8;  // of a velocity, from frame to frame
  Random random(seed);
  BlurredPath path;
  Vec2 centre = BlurredWorld::kMiddle, velocity{};
  for (int i = 0; i < frames; ++i) {
    path.centres.push_back(centre);
    const double speed = norm(velocity);
    const double direction =
        std::fmod(std::atan2(velocity.y, velocity.x) + 2 * std::numbers::pi, std::numbers::pi);
    path.blurs.push_back({.direction_rad = direction, .length_px = kOpenShare * speed});
    // Drawn back to the middle, so that the target stays in the picture.
    velocity = kKept * velocity + 0.3 * fastest * Vec2{random.normal(), random.normal()} -
               0.08 * (centre - BlurredWorld::kMiddle);
    if (norm(velocity) > fastest) velocity = (fastest / norm(velocity)) * velocity;
    const Vec2 next = centre + velocity, from_middle = next - BlurredWorld::kMiddle;
    if (std::abs(from_middle.x) > kReach - 10 || std::abs(from_middle.y) > kReach - 10)
      velocity = -1 * velocity;
    centre = centre + velocity;
  }
  return path;
}

}  // namespace relock
