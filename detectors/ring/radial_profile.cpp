#include "detectors/ring/radial_profile.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "detectors/ring/vector_clones.h"

namespace relock::ring {
namespace {

constexpr int kSamples = 1024;
constexpr float kPerRadius = static_cast<float>((kSamples - 1) / RadialProfile::kEnd);

/// Of a step from 1 to 0 at `edge`.
double smooth_step(double radius, double edge, double sigma) {
  return 0.5 * std::erfc((radius - edge) / (sigma * std::numbers::sqrt2));
}
double slope_of_step(double radius, double edge, double sigma) {
  const double z = (radius - edge) / sigma;
  return -std::exp(-0.5 * z * z) / (sigma * std::sqrt(2 * std::numbers::pi));
}

/// The sum of `of_step` over all edges of the annuli.
template <class OfStep>
double over_edges(const std::vector<Annulus>& annuli, OfStep of_step) {
  double sum = 0;
  for (const Annulus& annulus : annuli) {
    sum += of_step(annulus.outer);
    if (annulus.inner > 0) sum -= of_step(annulus.inner);
  }
  return sum;
}

/// Ranks of sigmas by the first bits of a variance, which tell it to 3 %: the exponent and five of the mantissa.
constexpr int kShift = 23 - 5;
constexpr std::int32_t bits_of(float value) { return std::bit_cast<std::int32_t>(value) >> kShift; }
struct Levels {
  static constexpr std::int32_t first =
      bits_of(static_cast<float>(RadialProfile::kLeastSigma * RadialProfile::kLeastSigma));
  static constexpr std::int32_t last = bits_of(1.0f);
  std::int32_t rank[last - first + 1];

  Levels() {
    for (std::int32_t bits = first; bits <= last; ++bits) {
      const double middle = std::bit_cast<float>((bits << kShift) + (1 << (kShift - 1)));
      const double level =
          std::log(std::sqrt(middle) / RadialProfile::kLeastSigma) / std::log(RadialProfile::kSigmaRatio);
      rank[bits - first] = std::clamp(static_cast<int>(std::lround(level)), 0, RadialProfile::kSigmas - 1);
    }
  }
};
const Levels& levels() {
  static const Levels made;
  return made;
}

}  // namespace

RadialProfile::RadialProfile(const std::vector<Annulus>& annuli) : annuli_(annuli) {
  table_.resize(static_cast<std::size_t>(2 * kSigmas * kSamples));
  float* out = table_.data();
  for (int level = 0; level < kSigmas; ++level) {
    const double sigma = kLeastSigma * std::pow(kSigmaRatio, level);
    for (int sample = 0; sample < kSamples; ++sample) {
      const double radius = kEnd * sample / (kSamples - 1);
      *out++ = static_cast<float>(value(radius, sigma));
      *out++ = static_cast<float>(slope(radius, sigma));
    }
    out[-2] = out[-1] = 0;  // beyond the end there is nothing to tell
  }
}

double RadialProfile::value(double radius, double sigma) const {
  return over_edges(annuli_, [&](double edge) { return smooth_step(radius, edge, sigma); });
}
double RadialProfile::slope(double radius, double sigma) const {
  return over_edges(annuli_, [&](double edge) { return slope_of_step(radius, edge, sigma); });
}

RELOCK_VECTOR_CLONES
void RadialProfile::mean(const Movements& moved, const float* variance, int n, int moments,
                         SweptLight& out) const {
  const float *qx = moved.qx, *qy = moved.qy, *ux = moved.ux, *uy = moved.uy, *k = moved.k;
  const float step = 1 / static_cast<float>(moments);
  const float* table = table_.data();
  const std::int32_t* ranks = levels().rank;
  std::int32_t row[kBlock];
  RELOCK_INDEPENDENT
  for (int i = 0; i < n; ++i) {
    const float radial = (qx[i] * ux[i] + qy[i] * uy[i]) * step;
    const float total = variance[i] + radial * radial / (12 * (qx[i] * qx[i] + qy[i] * qy[i]) + 1e-6f);
    std::int32_t bits = (std::bit_cast<std::int32_t>(total) >> kShift) - Levels::first;
    bits = bits < 0 ? 0 : bits;
    bits = bits > Levels::last - Levels::first ? Levels::last - Levels::first : bits;
    row[i] = ranks[bits] * kSamples;
    out.mean[i] = out.by_qx[i] = out.by_qy[i] = out.by_ux[i] = out.by_uy[i] = 0;
  }
  for (int moment = 0; moment < moments; ++moment) {
    const float t = (static_cast<float>(moment) + 0.5f) * step - 0.5f;
    RELOCK_INDEPENDENT
    for (int i = 0; i < n; ++i) {
      const float s = t / (1 + k[i] * t);
      const float x = qx[i] + s * ux[i], y = qy[i] + s * uy[i];
      const float radius = std::sqrt(x * x + y * y + 1e-8f);
      float place = radius * kPerRadius;
      place = place < kSamples - 1 ? place : kSamples - 1;
      const int sample = static_cast<int>(place + 0.5f);
      const float value = table[2 * (row[i] + sample)], slope = table[2 * (row[i] + sample) + 1];
      const float g = slope / radius * step, gx = g * x, gy = g * y;
      out.mean[i] += step * (value + slope * (place - static_cast<float>(sample)) * (1 / kPerRadius));
      out.by_qx[i] += gx, out.by_qy[i] += gy;
      out.by_ux[i] += s * gx, out.by_uy[i] += s * gy;
    }
  }
}

}  // namespace relock::ring
