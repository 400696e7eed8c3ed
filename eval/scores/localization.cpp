#include "eval/scores/localization.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace relock {
namespace {

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double rms(const std::vector<double>& values) {
  return std::sqrt(std::inner_product(values.begin(), values.end(), values.begin(), 0.0) /
                   static_cast<double>(values.size()));
}

void along_and_across_blur(std::span<const Fix> fixes, Localization& result) {
  std::vector<double> along, across;
  for (const Fix& fix : fixes) {
    const double length = fix.blur ? norm(*fix.blur) : 0;
    if (length <= 0) continue;
    const Vec2 u = (1 / length) * *fix.blur;
    along.push_back(dot(fix.error_px, u));
    across.push_back(dot(fix.error_px, {-u.y, u.x}));
  }
  if (along.empty()) return;
  result.along_blur_px = rms(along);
  result.across_blur_px = rms(across);
}

void bias_and_spread(std::span<const Fix> fixes, Localization& result) {
  Vec2 sum;
  for (const Fix& fix : fixes) sum = sum + fix.error_px;
  const Vec2 bias = (1.0 / static_cast<double>(fixes.size())) * sum;
  std::vector<double> apart;
  for (const Fix& fix : fixes) apart.push_back(norm(fix.error_px - bias));
  result.bias_px = bias;
  result.spread_px = rms(apart);
}

}  // namespace

std::vector<Fix> fixes(const Recording& recording, const Trajectory& trajectory, const Evaluation& evaluation,
                       std::size_t target) {
  std::vector<Fix> all;
  const auto& judgements = evaluation.targets[target].judgements;
  for (std::size_t frame = 0; frame < judgements.size(); ++frame) {
    if (judgements[frame].verdict != Verdict::Hit) continue;
    const TargetTruth& truth = recording.truth_of(frame, target);
    if (stems_from(truth.source, trajectory.method)) continue;
    const Sighting& seen =
        trajectory.frames[frame].sightings[static_cast<std::size_t>(judgements[frame].sighting)];
    all.push_back({frame, target, seen.centre - truth.centre(seen.centre_kind), truth.size_px(), truth.blur,
                   truth.sigma_px, seen.blur});
  }
  return all;
}

Localization localize(std::span<const Fix> fixes, std::size_t visible_frames) {
  Localization result;
  result.hits = fixes.size();
  std::vector<double> px, percent, sigma;
  for (const Fix& fix : fixes) {
    px.push_back(norm(fix.error_px));
    percent.push_back(100 * px.back() / fix.size_px);
    sigma.push_back(fix.sigma_px);
  }
  for (std::size_t i = 0; i < kWithinD.size() && visible_frames > 0; ++i) {
    std::size_t near = 0;
    for (std::size_t k = 0; k < fixes.size(); ++k) near += px[k] <= kWithinD[i] * fixes[k].size_px ? 1 : 0;
    result.within[i] = static_cast<double>(near) / static_cast<double>(visible_frames);
  }
  if (fixes.empty()) return result;
  result.mean_px = mean(px);
  result.rms_px = rms(px);
  result.median_px = percentile(px, 0.5);
  result.p95_px = percentile(px, 0.95);
  result.mean_percent = mean(percent);
  result.rms_percent = rms(percent);
  result.median_percent = percentile(percent, 0.5);
  result.p95_percent = percentile(percent, 0.95);
  if (const double s = rms(sigma); s > 0) result.label_sigma_px = s;
  bias_and_spread(fixes, result);
  along_and_across_blur(fixes, result);
  return result;
}

double percentile(std::vector<double> values, double share) {
  const double place = share * static_cast<double>(values.size() - 1);
  const auto below = values.begin() + static_cast<std::ptrdiff_t>(place);
  std::nth_element(values.begin(), below, values.end());
  const double part = place - std::floor(place);
  if (part <= 0) return *below;  // a value above that is infinite counts only where it has a part
  const double above = *std::min_element(below + 1, values.end());
  return *below + part * (above - *below);
}

}  // namespace relock
