#include "detectors/ring/radial_profile.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace relock::ring {
namespace {

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

double sigma_of(int level) {
  return RadialProfile::kLeastSigma * std::pow(RadialProfile::kSigmaRatio, level);
}

}  // namespace

RadialProfile::RadialProfile(const std::vector<Annulus>& annuli) : annuli_(annuli) {
  table_.resize(static_cast<std::size_t>(kSigmas) * kSamples);
  Rise* out = table_.data();
  for (int level = 0; level < kSigmas; ++level) {
    const double sigma = sigma_of(level);
    for (int sample = 0; sample < kSamples; ++sample) {
      const double radius = kEnd * sample / (kSamples - 1);
      out->value = static_cast<float>(exactly(radius, sigma));
      out->slope = static_cast<float>(
          over_edges(annuli_, [&](double edge) { return slope_of_step(radius, edge, sigma); }));
      ++out;
    }
    *(out - 1) = {};  // beyond the end there is nothing to tell
  }
}

double RadialProfile::exactly(double radius, double sigma) const {
  return over_edges(annuli_, [&](double edge) { return smooth_step(radius, edge, sigma); });
}

int RadialProfile::level_of(float sigma) {
  static const float per_octave = static_cast<float>(1 / std::log2(kSigmaRatio));
  const float level = std::log2(sigma * static_cast<float>(1 / kLeastSigma)) * per_octave;
  return std::clamp(static_cast<int>(std::lround(level)), 0, kSigmas - 1);
}

}  // namespace relock::ring
