#include "detectors/ring/swept_profile.h"

#include <algorithm>
#include <cmath>

#include "detectors/ring/vector_clones.h"

namespace relock::ring {
namespace {

constexpr int kSamples = 256, kNumbers = 4;
constexpr float kPerRadius = static_cast<float>((kSamples - 1) / SweptProfile::kEnd);
constexpr int kMoments = 2048;
constexpr float kMomentsPerRadius = static_cast<float>((kMoments - 1) / (1.5 * SweptProfile::kEnd));

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
  static constexpr int kSteps = 2048;  // a tenth of the least sigma
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
  constexpr int kSteps = 2;  // of the integration, between two samples
  const double step = kEnd / (kSamples - 1) / kSteps;
  const FineProfile fine(profile, sigma);
  double moment = 0;
  for (int i = 0; i <= kMoments; ++i) {  // one more, so that there is always a next one
    moment_.push_back(static_cast<float>(moment));
    const double radius = (i + 0.5) / kMomentsPerRadius;
    moment += fine.value(radius) * radius / kMomentsPerRadius;
  }
  float* out = table_.data();
  for (int row = 0; row < kSamples; ++row) {
    const double y = row * step * kSteps;
    double sum = 0, across = 0;
    for (int column = 0; column < kSamples; ++column, out += kNumbers) {
      const double x = column * step * kSteps;
      out[0] = static_cast<float>(sum), out[1] = static_cast<float>(fine.value(std::sqrt(x * x + y * y)));
      out[2] = static_cast<float>(across);
      for (int k = 0; k < kSteps; ++k) {
        const double radius = std::sqrt((x + (k + 0.5) * step) * (x + (k + 0.5) * step) + y * y);
        sum += fine.value(radius) * step;
        across += fine.slope(radius) * y / radius * step;
      }
    }
  }
}

namespace {

/// The movement of a block of points in coordinates along it (x) and across it (y).
struct Along {
  alignas(32) Row ex, ey;         // the direction
  alignas(32) Row x, y, inverse;  // inverse of the length
  alignas(32) Row ahead, behind;  // x at both ends
  alignas(32) Row s1, s0;         // parts of the length from x to them
};

RELOCK_VECTOR_CLONES
void find_ends(const Movements& moved, int n, Along& out) {
  const float *qx = moved.qx, *qy = moved.qy, *ux = moved.ux, *uy = moved.uy, *k = moved.k;
  RELOCK_INDEPENDENT
  for (int i = 0; i < n; ++i) {
    const float length = std::sqrt(ux[i] * ux[i] + uy[i] * uy[i]), inverse = 1 / length;
    const float ex = ux[i] * inverse, ey = uy[i] * inverse;
    const float x = qx[i] * ex + qy[i] * ey;
    const float s1 = 0.5f / (1 + 0.5f * k[i]), s0 = -0.5f / (1 - 0.5f * k[i]);
    out.ex[i] = ex, out.ey[i] = ey, out.inverse[i] = inverse;
    out.x[i] = x, out.y[i] = qy[i] * ex - qx[i] * ey;  // y along (-ey, ex)
    out.s1[i] = s1, out.s0[i] = s0;
    out.ahead[i] = x + s1 * length, out.behind[i] = x + s0 * length;
  }
}

}  // namespace

RELOCK_VECTOR_CLONES
void SweptProfile::mean(const Movements& moved, int n, SweptLight& out) const {
  constexpr float kLast = kSamples - 1;
  const float* table = table_.data();
  Along at;
  find_ends(moved, n, at);
  RELOCK_INDEPENDENT
  for (int i = 0; i < n; ++i) {
    const float x = at.x[i], y = at.y[i], inverse = at.inverse[i], ex = at.ex[i], ey = at.ey[i];
    float row = std::abs(y) * kPerRadius;
    row = row < kLast ? row : kLast;
    const int j = static_cast<int>(row + 0.5f);
    const float dy = (row - static_cast<float>(j)) / kPerRadius;
    float sum = 0, difference = 0, across = 0, by_length = 0;
    for (int end = 0; end < 2; ++end) {
      const float s = end == 0 ? at.ahead[i] : at.behind[i], part = end == 0 ? at.s1[i] : at.s0[i];
      float column = std::abs(s) * kPerRadius;
      column = column < kLast ? column : kLast;
      const int c = static_cast<int>(column + 0.5f);
      const float dx = (column - static_cast<float>(c)) / kPerRadius;
      const int place = kNumbers * (j * kSamples + c);
      const float p = table[place + 1], gy = table[place + 2];
      // G and dG/dy are odd in x, P is even; the end behind counts negative.
      const float forward = end == 0 ? 1.0f : -1.0f, sign = (s < 0 ? -1.0f : 1.0f) * forward;
      sum += sign * (table[place] + p * dx + gy * dy), across += sign * gy;
      difference += forward * p, by_length += forward * part * p;
    }
    const float mean = sum * inverse, by_x = difference * inverse;
    const float by_y = (y < 0 ? -across : across) * inverse;
    const float lengthened = (by_length - mean) * inverse;
    const float by_turn = (y * by_x - x * by_y) * inverse;  // for a change of u across itself
    out.mean[i] = mean;
    out.by_qx[i] = ex * by_x - ey * by_y, out.by_qy[i] = ey * by_x + ex * by_y;
    out.by_ux[i] = ex * lengthened - ey * by_turn, out.by_uy[i] = ey * lengthened + ex * by_turn;
  }
  const float* moment = moment_.data();
  constexpr float kLastMoment = kMoments - 1;
  RELOCK_INDEPENDENT
  for (int i = 0; i < n; ++i) {
    float ahead = std::sqrt(at.ahead[i] * at.ahead[i] + at.y[i] * at.y[i]) * kMomentsPerRadius;
    float behind = std::sqrt(at.behind[i] * at.behind[i] + at.y[i] * at.y[i]) * kMomentsPerRadius;
    ahead = ahead < kLastMoment ? ahead : kLastMoment, behind = behind < kLastMoment ? behind : kLastMoment;
    const int a = static_cast<int>(ahead), b = static_cast<int>(behind);
    const float difference = moment[a] + (ahead - static_cast<float>(a)) * (moment[a + 1] - moment[a]) -
                             moment[b] - (behind - static_cast<float>(b)) * (moment[b + 1] - moment[b]);
    out.mean[i] += 2 * moved.k[i] * (difference * at.inverse[i] - at.x[i] * out.mean[i]) * at.inverse[i];
  }
}

}  // namespace relock::ring
