#pragma once

#include <vector>

#include "detectors/ring_marker.h"

// What a marker looks like along a radius, through a lens. Lengths are parts of the outermost ring's radius.

namespace relock::ring {

/// A value and its slope.
struct Rise {
  float value = 0;
  float slope = 0;
};

/// The light of some annuli about one middle, 1 in them and 0 outside, smoothed by a Gaussian: against the
/// radius, for any width of the Gaussian that matters. An edge is smoothed as if it were straight, which is
/// right to the second order of sigma over its radius.
class RadialProfile {
 public:
  explicit RadialProfile(const std::vector<Annulus>& annuli);

  /// Beyond this radius the tables have no light. It is well beyond any edge that they are made for.
  static constexpr double kEnd = 2.4;
  static constexpr double kLeastSigma = 0.004, kSigmaRatio = 1.2;
  static constexpr int kSigmas = 24;

  /// At `radius` >= 0, smoothed by the nearest sigma that there is.
  Rise at(float radius, float sigma) const {
    const Rise* row = &table_[static_cast<std::size_t>(level_of(sigma)) * kSamples];
    const float place = std::min(radius * kPerRadius, static_cast<float>(kSamples - 1));
    const int sample = static_cast<int>(place + 0.5f);
    const Rise& near = row[sample];
    return {near.value + near.slope * (place - static_cast<float>(sample)) * (1 / kPerRadius), near.slope};
  }
  /// The exact value.
  double exactly(double radius, double sigma) const;

 private:
  static constexpr int kSamples = 1024;
  static constexpr float kPerRadius = static_cast<float>((kSamples - 1) / kEnd);
  static int level_of(float sigma);

  std::vector<Annulus> annuli_;
  std::vector<Rise> table_;  // a row for each sigma
};

}  // namespace relock::ring
