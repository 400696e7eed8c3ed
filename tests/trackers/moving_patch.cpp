#include "tests/trackers/moving_patch.h"

#include <opencv2/imgproc.hpp>

#include "core/opencv.h"

namespace relock {
namespace {

constexpr int kWidth = 32, kHeight = 28;

cv::Mat3b texture(cv::Size size, std::uint64_t seed, double grain_px, double low, double high) {
  cv::Mat3b noise(size);
  cv::RNG(seed).fill(noise, cv::RNG::UNIFORM, low, high);
  cv::GaussianBlur(noise, noise, {0, 0}, grain_px);
  cv::Mat stretched;
  cv::normalize(noise.reshape(1), stretched, low, high, cv::NORM_MINMAX);
  return stretched.reshape(3);
}

}  // namespace

cv::Mat3b bare_wall() { return texture({160, 120}, 11, 2, 80, 120); }

cv::Mat3b patch_at(Vec2 p) {
  // Moved by parts of a pixel together with a mask, so that its edges move too.
  const cv::Mat3b patch = texture({kWidth, kHeight}, 5, 3, 20, 240);
  const cv::Matx23d shift(1, 0, p.x, 0, 1, p.y);
  const cv::Mat3b wall = bare_wall();
  cv::Mat moved, mask;
  cv::warpAffine(patch, moved, shift, wall.size());
  cv::warpAffine(cv::Mat3b(patch.size(), cv::Vec3b::all(255)), mask, shift, wall.size());
  cv::Mat3b picture;
  cv::add(moved, wall.mul(cv::Scalar::all(255) - mask, 1.0 / 255), picture);
  return picture;
}

Box patch_box(Vec2 p) { return {p.x - 0.5, p.y - 0.5, kWidth, kHeight}; }

Frame frame_of(const cv::Mat& pixels, FrameIndex index) {
  return {index, time_ns(index * 1'000'000'000 / 30), view(pixels)};
}

}  // namespace relock
