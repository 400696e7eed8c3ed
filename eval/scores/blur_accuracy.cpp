#include "eval/scores/blur_accuracy.h"

#include <cmath>
#include <numbers>
#include <vector>

namespace relock {

BlurAccuracy blur_accuracy(std::span<const Fix> fixes) {
  BlurAccuracy result;
  std::vector<double> directions_deg, lengths_percent;
  for (const Fix& fix : fixes) {
    if (!fix.blur) continue;
    const double length = norm(*fix.blur);
    if (length <= kSharp * fix.size_px) {
      ++result.sharp;
      result.sharp_blurred += fix.told_blur && fix.told_blur->length_px > kBlurred * fix.size_px ? 1 : 0;
    }
    if (length < kBlurred * fix.size_px) continue;
    ++result.blurred;
    if (!fix.told_blur) continue;
    ++result.told;
    const double apart = between_axes(fix.told_blur->direction_rad, std::atan2(fix.blur->y, fix.blur->x));
    directions_deg.push_back(apart * 180 / std::numbers::pi);
    lengths_percent.push_back(100 * std::abs(fix.told_blur->length_px - length) / length);
  }
  if (directions_deg.empty()) return result;
  result.direction_median_deg = percentile(directions_deg, 0.5);
  result.direction_p95_deg = percentile(directions_deg, 0.95);
  result.length_median_percent = percentile(lengths_percent, 0.5);
  result.length_p95_percent = percentile(lengths_percent, 0.95);
  return result;
}

}  // namespace relock
