#include "detectors/ring/swept_profile.h"

#include <algorithm>
#include <cmath>

#include "detectors/ring/vector_clones.h"

namespace relock::ring {
namespace {

constexpr int kSamples = 256, kNumbers = 4;
constexpr float kPerRadius = static_cast<float>((kSamples - 1) / SweptProfile::kEnd);

/// The profile along the radius, fine enough to integrate over.
class FineProfile {
 public:
  FineProfile(const RadialProfile& profile, double sigma) {
    for (int i = 0; i < kSteps; ++i) {
      const double radius = i * kStep;
      value_.push_back(profile.value(radius, sigma)), slope_.push_back(profile.slope(radius, sigma));
    }
  }
  double value(double radius) const { return between(value_, radius); }
  double slope(double radius) const { return between(slope_, radius); }

 private:
  static constexpr int kSteps = 8192;
  static constexpr double kStep = 1.5 * SweptProfile::kEnd / kSteps;
  static double between(const std::vector<double>& values, double radius) {
    const double place = std::min(radius / kStep, kSteps - 1.001);
    const auto i = static_cast<std::size_t>(place);
    return values[i] + (place - static_cast<double>(i)) * (values[i + 1] - values[i]);
  }
  std::vector<double> value_, slope_;
};

}  // namespace

SweptProfile::SweptProfile(const RadialProfile& profile, double sigma)
    : table_(static_cast<std::size_t>(kSamples * kSamples * kNumbers)) {
  constexpr int kSteps = 4;  // of the integration, between two samples
  const double step = kEnd / (kSamples - 1) / kSteps;
  const FineProfile fine(profile, sigma);
  float* out = table_.data();
  for (int row = 0; row < kSamples; ++row) {
    const double y = row * step * kSteps;
    double sum = 0, across = 0;
    for (int column = 0; column < kSamples; ++column, out += kNumbers) {
      const double x = column * step * kSteps;
      out[0] = static_cast<float>(sum), out[1] = static_cast<float>(fine.value(std::hypot(x, y)));
      out[2] = static_cast<float>(across);
      for (int k = 0; k < kSteps; ++k) {
        const double radius = std::sqrt((x + (k + 0.5) * step) * (x + (k + 0.5) * step) + y * y);
        sum += fine.value(radius) * step;
        across += fine.slope(radius) * y / radius * step;
      }
    }
  }
}

RELOCK_VECTOR_CLONES
void SweptProfile::mean(const float* qx, const float* qy, const float* ux, const float* uy, int n,
                        SweptLight& out) const {
  constexpr float kLast = kSamples - 1;
  const float* table = table_.data();
  RELOCK_INDEPENDENT
  for (int i = 0; i < n; ++i) {
    const float length = std::sqrt(ux[i] * ux[i] + uy[i] * uy[i]), inverse = 1 / length;
    const float ex = ux[i] * inverse, ey = uy[i] * inverse;
    const float x = qx[i] * ex + qy[i] * ey, y = qy[i] * ex - qx[i] * ey;  // y along (-ey, ex)
    float row = std::abs(y) * kPerRadius;
    row = row < kLast ? row : kLast;
    const int j = static_cast<int>(row + 0.5f);
    const float dy = (row - static_cast<float>(j)) / kPerRadius;
    float sum = 0, along = 0, difference = 0, across = 0;
    for (int end = 0; end < 2; ++end) {
      const float s = end == 0 ? x + 0.5f * length : x - 0.5f * length;
      float column = std::abs(s) * kPerRadius;
      column = column < kLast ? column : kLast;
      const int k = static_cast<int>(column + 0.5f);
      const float dx = (column - static_cast<float>(k)) / kPerRadius;
      const int place = kNumbers * (j * kSamples + k);
      const float p = table[place + 1], gy = table[place + 2];
      // G and dG/dy are odd in x, P is even; the end behind counts negative.
      const float sign = (s < 0 ? -1.0f : 1.0f) * (end == 0 ? 1.0f : -1.0f);
      sum += sign * (table[place] + p * dx + gy * dy), across += sign * gy;
      along += p, difference += end == 0 ? p : -p;
    }
    const float mean = sum * inverse, by_x = difference * inverse;
    const float by_y = (y < 0 ? -across : across) * inverse;
    const float by_length = (0.5f * along - mean) * inverse;
    const float by_turn = (y * by_x - x * by_y) * inverse;  // for a change of u across itself
    out.mean[i] = mean;
    out.by_qx[i] = ex * by_x - ey * by_y, out.by_qy[i] = ey * by_x + ex * by_y;
    out.by_ux[i] = ex * by_length - ey * by_turn, out.by_uy[i] = ey * by_length + ex * by_turn;
  }
}

}  // namespace relock::ring
