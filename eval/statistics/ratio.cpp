#include "eval/statistics/ratio.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "eval/statistics/long_run.h"

namespace relock {
namespace {

struct Ratio {
  double part = 0, whole = 0;
  bool share = true;  ///< every frame's part lies in [0, whole]
  double value() const { return part / whole; }
};

Ratio ratio(std::span<const RatioSeries> sequences) {
  Ratio all;
  for (const RatioSeries& s : sequences) {
    for (std::size_t i = 0; i < s.part.size(); ++i) {
      all.part += s.part[i];
      all.whole += s.whole[i];
      all.share = all.share && s.part[i] >= 0 && s.part[i] <= s.whole[i];
    }
  }
  return all;
}

/// What each frame does to the ratio, to first order.
std::vector<std::vector<double>> influence(std::span<const RatioSeries> sequences, const Ratio& all) {
  std::vector<std::vector<double>> influences;
  for (const RatioSeries& s : sequences) {
    std::vector<double>& e = influences.emplace_back(s.part.size());
    for (std::size_t i = 0; i < e.size(); ++i) e[i] = (s.part[i] - all.value() * s.whole[i]) / all.whole;
  }
  return influences;
}

/// The standard error times Student's quantile.
std::optional<double> margin(std::span<const std::vector<double>> influences) {
  const auto found = long_run_variance(influences);
  if (!found) return {};
  return std::sqrt(found->variance) * student_quantile(found->freedom);
}

/// How far the interval reaches to either side of the estimate.
struct Reach {
  double down = 0, up = 0;
};

/// Of a share: symmetric on the scale of log odds, where its ends are infinitely far away.
Reach reach_of_share(double share, double half) {
  const double odds = share / (1 - share), factor = std::exp(half / (share * (1 - share)));
  return {share - 1 + 1 / (1 + odds / factor), 1 - 1 / (1 + odds * factor) - share};
}

bool same_frames(std::span<const RatioSeries> a, std::span<const RatioSeries> b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const RatioSeries& x, const RatioSeries& y) { return x.whole == y.whole; });
}

/// Of a difference of shares of the same frames: a share gained less a share lost, each as lopsided as a share
/// is, their reaches combined as the method of variance estimates recovery does (Zou and Donner 2008).
Reach reach_of_difference(std::span<const RatioSeries> a, std::span<const RatioSeries> b, double whole,
                          double half) {
  double gained = 0, lost = 0;
  for (std::size_t s = 0; s < a.size(); ++s) {
    for (std::size_t i = 0; i < a[s].part.size(); ++i) {
      const double gain = (a[s].part[i] - b[s].part[i]) / whole;
      (gain > 0 ? gained : lost) += std::abs(gain);
    }
  }
  const double either = gained + lost;
  if (!(either > 0) || either >= 1) return {half, half};
  const Reach most = reach_of_share(either, half);
  const auto reach = [&](double share) {
    if (share <= 0) return Reach{};
    const Reach own = reach_of_share(share, half * std::sqrt(share / either));
    // Of a few frames alone next to nothing would be known.
    return Reach{std::min(own.down, most.down), std::min(own.up, most.up)};
  };
  const Reach gain = reach(gained), loss = reach(lost);
  return {std::hypot(gain.down, loss.up), std::hypot(gain.up, loss.down)};
}

}  // namespace

std::optional<Interval> ratio_interval(std::span<const RatioSeries> sequences) {
  const Ratio all = ratio(sequences);
  if (!(all.whole > 0)) return {};
  const auto half = margin(influence(sequences, all));
  if (!half) return {};
  const double value = all.value();
  const Reach reach = all.share ? reach_of_share(value, *half) : Reach{*half, *half};
  return Interval{value - reach.down, value + reach.up};
}

std::optional<Interval> difference_interval(std::span<const RatioSeries> a, std::span<const RatioSeries> b) {
  const Ratio all_a = ratio(a), all_b = ratio(b);
  if (!(all_a.whole > 0) || !(all_b.whole > 0)) return {};
  auto difference = influence(a, all_a);
  const auto of_b = influence(b, all_b);
  for (std::size_t s = 0; s < difference.size(); ++s)
    for (std::size_t i = 0; i < difference[s].size(); ++i) difference[s][i] -= of_b[s][i];
  const auto half = margin(difference);
  if (!half) return {};
  const bool shares = all_a.share && all_b.share && same_frames(a, b);
  const Reach reach = shares ? reach_of_difference(a, b, all_a.whole, *half) : Reach{*half, *half};
  const double value = all_a.value() - all_b.value();
  return Interval{value - reach.down, value + reach.up};
}

namespace {

/// Of each frame that has values, in order, how many of them are at most `limit`.
RatioSeries at_most(double limit, std::vector<FramedValue> values) {
  std::stable_sort(values.begin(), values.end(),
                   [](const FramedValue& a, const FramedValue& b) { return a.frame < b.frame; });
  RatioSeries series;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i == 0 || values[i].frame != values[i - 1].frame) {
      series.part.push_back(0);
      series.whole.push_back(0);
    }
    series.part.back() += values[i].value <= limit ? 1 : 0;
    series.whole.back() += 1;
  }
  return series;
}

}  // namespace

std::optional<Interval> quantile_interval(std::span<const std::vector<FramedValue>> values_by_sequence,
                                          double share) {
  std::vector<double> sorted;
  for (const auto& values : values_by_sequence)
    for (const FramedValue& value : values) sorted.push_back(value.value);
  if (sorted.empty()) return {};
  std::sort(sorted.begin(), sorted.end());
  // Between order statistics as `percentile` interpolates (eval/scores/localization.h).
  const auto quantile = [&](double at) {
    const double position = std::clamp(at, 0.0, 1.0) * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(position);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (position - static_cast<double>(below)) * (sorted[above] - sorted[below]);
  };
  const double estimate = quantile(share);
  std::vector<RatioSeries> all;
  for (const auto& values : values_by_sequence) all.push_back(at_most(estimate, values));
  const auto shares = ratio_interval(all);
  if (!shares) return {};
  return Interval{quantile(shares->low), quantile(shares->high)};
}

}  // namespace relock
