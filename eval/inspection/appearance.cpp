#include "eval/inspection/appearance.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "core/opencv.h"

namespace relock {
namespace {

constexpr int kBlock = 8;
constexpr std::uint64_t kFewestBlocks = 50;
/// Of pure noise, a tenth of the blocks show less than this part of it.
constexpr double kQuietestTenth = 0.79;

/// Where in a histogram the share of all that lies below is `share`, in bins.
double quantile_bin(const std::uint64_t* bins, std::size_t count, std::uint64_t total, double share) {
  const double wanted = share * static_cast<double>(total);
  double passed = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto here = static_cast<double>(bins[i]);
    if (passed + here >= wanted && here > 0) return static_cast<double>(i) + (wanted - passed) / here;
    passed += here;
  }
  return static_cast<double>(count);
}

/// Mean absolute answer of [1 -2 1; -2 4 -2; 1 -2 1] over the block at (x, y), as a standard deviation.
double noise_of_block(const cv::Mat& gray, int x, int y) {
  int sum = 0;
  for (int j = y; j < y + kBlock; ++j) {
    const std::uint8_t *a = gray.ptr(j - 1), *b = gray.ptr(j), *c = gray.ptr(j + 1);
    for (int i = x; i < x + kBlock; ++i)
      sum += std::abs(a[i - 1] - 2 * a[i] + a[i + 1] - 2 * b[i - 1] + 4 * b[i] - 2 * b[i + 1] + c[i - 1] -
                      2 * c[i] + c[i + 1]);
  }
  return std::sqrt(std::numbers::pi / 2) / 6 * sum / (kBlock * kBlock);
}

double mean_of_block(const cv::Mat& gray, int x, int y) {
  int sum = 0;
  for (int j = y; j < y + kBlock; ++j)
    for (int i = x; i < x + kBlock; ++i) sum += gray.at<std::uint8_t>(j, i);
  return sum / static_cast<double>(kBlock * kBlock);
}

}  // namespace

AppearanceGatherer::AppearanceGatherer() : gradients_(kGradients), noises_(Appearance::kShades * kNoises) {}

void AppearanceGatherer::add(const Image& picture) {
  cv::Mat buffer;
  const cv::Mat gray = gray_of(picture, buffer);
  for (int y = 1; y + 1 < gray.rows; ++y) {
    const std::uint8_t *above = gray.ptr(y - 1), *row = gray.ptr(y), *below = gray.ptr(y + 1);
    for (int x = 1; x + 1 < gray.cols; ++x) {
      const double dx = (row[x + 1] - row[x - 1]) / 2.0, dy = (below[x] - above[x]) / 2.0;
      ++gradients_[std::min(static_cast<std::size_t>(4 * std::hypot(dx, dy)), kGradients - 1)];
      gray_sum_ += row[x];
    }
  }
  inner_ += static_cast<std::uint64_t>(std::max(0, gray.rows - 2)) *
            static_cast<std::uint64_t>(std::max(0, gray.cols - 2));
  for (int y = 1; y + kBlock < gray.rows; y += kBlock)
    for (int x = 1; x + kBlock < gray.cols; x += kBlock) {
      const auto shade =
          std::min(static_cast<std::size_t>(mean_of_block(gray, x, y) / 32), Appearance::kShades - 1);
      const auto bin = std::min(static_cast<std::size_t>(16 * noise_of_block(gray, x, y)), kNoises - 1);
      ++noises_[shade * kNoises + bin];
    }
}

Appearance AppearanceGatherer::result() const {
  Appearance appearance;
  if (inner_ == 0) return appearance;
  appearance.mean_gray = gray_sum_ / static_cast<double>(inner_);
  double sum = 0;
  for (std::size_t i = 0; i < kGradients; ++i)
    sum += (static_cast<double>(i) + 0.5) * static_cast<double>(gradients_[i]);
  appearance.gradient_mean = sum / static_cast<double>(inner_) / 4;
  appearance.gradient_p95 = quantile_bin(gradients_.data(), kGradients, inner_, 0.95) / 4;
  for (std::size_t shade = 0; shade < Appearance::kShades; ++shade) {
    const std::uint64_t* bins = noises_.data() + shade * kNoises;
    std::uint64_t blocks = 0;
    for (std::size_t i = 0; i < kNoises; ++i) blocks += bins[i];
    if (blocks >= kFewestBlocks)
      appearance.noise[shade] = quantile_bin(bins, kNoises, blocks, 0.1) / 16 / kQuietestTenth;
  }
  return appearance;
}

}  // namespace relock
