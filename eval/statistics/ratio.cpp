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

}  // namespace

std::optional<Interval> ratio_interval(std::span<const RatioSeries> sequences) {
  const Ratio all = ratio(sequences);
  if (!(all.whole > 0)) return {};
  const auto half = margin(influence(sequences, all));
  if (!half) return {};
  const double value = all.value();
  if (!all.share) return Interval{value - *half, value + *half};
  // On the scale of log odds, where a share is as far from its ends on both sides.
  const double odds = value / (1 - value), factor = std::exp(*half / (value * (1 - value)));
  return Interval{1 - 1 / (1 + odds / factor), 1 - 1 / (1 + odds * factor)};
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
  const double value = all_a.value() - all_b.value();
  return Interval{value - *half, value + *half};
}

}  // namespace relock
