#include "sequences/simulator/sensor.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/display_coding.h"
#include "core/error.h"
#include "core/random.h"
#include "sequences/simulator/range.h"
#include "sequences/simulator/sensor_noise.h"

namespace relock::simulator {
namespace {

/// Lindeberg's discrete Gaussian, e^-t I_n(t) with t = sigma^2. Samples of the continuous one have half of the
/// variance that was asked for when sigma is 0.4 px, where lenses are.
cv::Mat1f gaussian(double sigma) {
  const double t = sigma * sigma;
  const int radius = cvCeil(3 * sigma) + 1;
  cv::Mat1d kernel(2 * radius + 1, 1);
  for (int n = -radius; n <= radius; ++n)
    kernel(n + radius) = std::exp(-t) * std::cyl_bessel_i(static_cast<double>(std::abs(n)), t);
  kernel /= cv::sum(kernel)[0];
  cv::Mat1f narrow;
  kernel.convertTo(narrow, CV_32F);
  return narrow;
}

void blur(const cv::Mat& from, cv::Mat& to, double sigma) {
  const cv::Mat1f kernel = gaussian(sigma);
  cv::sepFilter2D(from, to, CV_32F, kernel, kernel, {-1, -1}, 0, cv::BORDER_REPLICATE);
}

/// How light falls off from the middle of a picture.
class Falloff {
 public:
  Falloff(double lost_in_corners, cv::Size size)
      : middle_(static_cast<float>(size.width - 1) / 2, static_cast<float>(size.height - 1) / 2) {
    const double corner = static_cast<double>(middle_.dot(middle_));
    if (corner > 0) k_ = static_cast<float>((1 / std::sqrt(1 - lost_in_corners) - 1) / corner);
  }

  void apply(float* light, int y, int width) const {
    const float dy = static_cast<float>(y) - middle_.y;
    for (int x = 0; x < width; ++x, light += 3) {
      const float dx = static_cast<float>(x) - middle_.x;
      const float root = 1 / (1 + k_ * (dx * dx + dy * dy));
      for (int c = 0; c < 3; ++c) light[c] *= root * root;
    }
  }

 private:
  cv::Point2f middle_;
  float k_ = 0;
};

/// Gain and noise; `signal` is light before and the signal after.
class Exposure {
 public:
  Exposure(const SensorPlan& plan, double gain, std::uint64_t seed)
      : gain_(static_cast<float>(gain)), noisy_(plan.full_well_e > 0), frame_(seed) {
    if (!noisy_) return;
    const double reading = gain * plan.read_noise_e / plan.full_well_e;
    shot_ = static_cast<float>(gain / plan.full_well_e);
    reading_ = static_cast<float>(reading * reading);
  }

  // Each row has a generator of its own, so that it does not matter who makes which row, or when.
  void apply(float* signal, int y, int samples) const {
    if (!noisy_) {
      for (int i = 0; i < samples; ++i) signal[i] *= gain_;
      return;
    }
    Noise noise(frame_.fork(static_cast<std::uint64_t>(y)));
    int i = 0;
    for (; i + 4 <= samples; i += 4) add(noise.next(), signal + i, 4);
    add(noise.next(), signal + i, samples - i);
  }

 private:
  void add(const std::array<float, 4>& normal, float* signal, int samples) const {
    for (int i = 0; i < samples; ++i) {
      const float light = gain_ * signal[i];
      signal[i] = light + normal[static_cast<std::size_t>(i)] * std::sqrt(shot_ * light + reading_);
    }
  }

  float gain_, shot_ = 0, reading_ = 0;
  bool noisy_;
  Random frame_;
};

/// sRGB coding by table. The steps of light are so fine that at most one step of the coding falls into each.
class DisplayTable {
 public:
  DisplayTable() {
    for (std::size_t i = 0; i < coded_.size(); ++i) {
      const double coded = 255 * coded_of_light(static_cast<double>(i) / kSteps);
      coded_[i] = static_cast<float>(coded);
      byte_[i] = static_cast<std::uint8_t>(std::min(254.0, coded + 0.5));
    }
    for (std::size_t b = 0; b < next_.size(); ++b)
      next_[b] = static_cast<float>(light_of_coded((static_cast<double>(b) + 0.5) / 255));
  }

  /// The nearest byte, exactly, of light in [0, 1].
  std::uint8_t byte(float light) const {
    const std::uint8_t below = byte_[static_cast<std::size_t>(light * kSteps)];
    return static_cast<std::uint8_t>(below + (light >= next_[below] ? 1 : 0));
  }
  /// From 0 to 255, to a hundredth.
  float coded(float light) const {
    const float at = light * kSteps;
    const auto i = std::min(static_cast<std::size_t>(at), kSteps - 1);
    return coded_[i] + (at - static_cast<float>(i)) * (coded_[i + 1] - coded_[i]);
  }

 private:
  static constexpr std::size_t kSteps = 4096;
  std::array<float, kSteps + 1> coded_{};
  std::array<std::uint8_t, kSteps + 1> byte_{};
  std::array<float, 256> next_{};  // the light from which on the next byte is nearer
};

const DisplayTable& display_table() {
  static const DisplayTable table;
  return table;
}

float clipped(float signal) { return std::min(std::max(signal, 0.0f), 1.0f); }

void write_bytes(const float* signal, bool srgb, std::uint8_t* bytes, int samples) {
  const DisplayTable& table = display_table();
  for (int i = 0; i < samples; ++i) {
    const float light = clipped(signal[i]);
    bytes[i] = srgb ? table.byte(light) : static_cast<std::uint8_t>(255 * light + 0.5f);
  }
}

void write_coded(float* signal, bool srgb, int samples) {
  const DisplayTable& table = display_table();
  for (int i = 0; i < samples; ++i) {
    const float light = clipped(signal[i]);
    signal[i] = srgb ? table.coded(light) : 255 * light;
  }
}

}  // namespace

void check_sensor(const SensorPlan& plan) {
  check_range("sensor: full_well_e", plan.full_well_e, 0, 1e9);
  check_range("sensor: read_noise_e", plan.read_noise_e, 0, 1e9);
  check_range("sensor: vignetting", plan.vignetting, 0, 0.99);
  check_range("sensor: defocus_px", plan.defocus_px, 0, 20);
  check_range("sensor: sharpening", plan.sharpening, 0, 10);
}

void develop(cv::Mat& light, const SensorPlan& plan, double gain, std::uint64_t seed, cv::Mat& out) {
  CV_Assert(light.type() == CV_32FC3);
  if (plan.defocus_px > 0) blur(light, light, plan.defocus_px);
  const Falloff falloff(plan.vignetting, light.size());
  const Exposure exposure(plan, gain, seed);
  const int samples = 3 * light.cols;
  out.create(light.size(), CV_8UC3);
  for (int y = 0; y < light.rows; ++y) {
    auto* row = light.ptr<float>(y);
    if (plan.vignetting > 0) falloff.apply(row, y, light.cols);
    exposure.apply(row, y, samples);
    if (plan.sharpening > 0) {
      write_coded(row, plan.srgb, samples);
    } else {
      write_bytes(row, plan.srgb, out.ptr(y), samples);
    }
  }
  if (plan.sharpening > 0) {
    thread_local cv::Mat blurred;
    blur(light, blurred, 1);
    cv::addWeighted(light, 1 + plan.sharpening, blurred, -plan.sharpening, 0, out, CV_8U);
  }
}

}  // namespace relock::simulator
