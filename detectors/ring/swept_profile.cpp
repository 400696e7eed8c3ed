#include "detectors/ring/swept_profile.h"

#include <algorithm>
#include <cmath>

namespace relock::ring {

SweptProfile::SweptProfile(const RadialProfile& profile, double sigma)
    : table_(static_cast<std::size_t>(kSamples) * kSamples) {
  constexpr int kSteps = 4;  // of the integration, between two samples
  const double step = kEnd / (kSamples - 1) / kSteps;
  const auto s = static_cast<float>(sigma);
  for (int row = 0; row < kSamples; ++row) {
    const auto y = static_cast<float>(row) / kPerRadius;
    double sum = 0, across = 0;
    Entry* out = &table_[static_cast<std::size_t>(row) * kSamples];
    for (int column = 0; column < kSamples; ++column) {
      const auto x = static_cast<float>(column) / kPerRadius;
      out[column] = {static_cast<float>(sum), profile.at(std::hypot(x, y), s).value, static_cast<float>(across), 0};
      for (int k = 0; k < kSteps; ++k) {
        const float radius = std::hypot(x + static_cast<float>((k + 0.5) * step), y);
        const Rise rise = profile.at(radius, s);
        sum += rise.value * step;
        across += rise.slope * y / std::max(radius, 1e-6f) * step;
      }
    }
  }
}

SweptProfile::Entry SweptProfile::read(float x, float y) const {
  constexpr float kLast = kSamples - 1;
  const float column = std::min(std::abs(x) * kPerRadius, kLast), row = std::min(y * kPerRadius, kLast);
  const int i = static_cast<int>(column + 0.5f), j = static_cast<int>(row + 0.5f);
  Entry near = table_[static_cast<std::size_t>(j) * kSamples + static_cast<std::size_t>(i)];
  const float dx = (column - static_cast<float>(i)) / kPerRadius, dy = (row - static_cast<float>(j)) / kPerRadius;
  near.sum += near.along * dx + near.across * dy;
  if (x < 0) near.sum = -near.sum, near.across = -near.across;
  return near;
}

SweptLight SweptProfile::at(const float q[2], const float u[2]) const {
  const float length = std::sqrt(u[0] * u[0] + u[1] * u[1]), inverse = 1 / length;
  const float e[2] = {u[0] * inverse, u[1] * inverse};
  const float x = q[0] * e[0] + q[1] * e[1];
  const float y = q[1] * e[0] - q[0] * e[1];  // along (-e1, e0)
  const Entry ahead = read(x + 0.5f * length, std::abs(y)), behind = read(x - 0.5f * length, std::abs(y));
  const float mean = (ahead.sum - behind.sum) * inverse;
  const float by_x = (ahead.along - behind.along) * inverse;
  const float by_y = (y < 0 ? behind.across - ahead.across : ahead.across - behind.across) * inverse;
  const float by_length = (0.5f * (ahead.along + behind.along) - mean) * inverse;
  const float by_turn = (y * by_x - x * by_y) * inverse;  // for a change of u across itself
  return {mean,
          {e[0] * by_x - e[1] * by_y, e[1] * by_x + e[0] * by_y},
          {e[0] * by_length - e[1] * by_turn, e[1] * by_length + e[0] * by_turn}};
}

}  // namespace relock::ring
