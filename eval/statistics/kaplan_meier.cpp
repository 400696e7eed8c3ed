#include "eval/statistics/kaplan_meier.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace relock {
namespace {
constexpr double kRounding =
    1e-12;  // products of exact fractions, as 3/4 · 2/3, miss 1/2 by this much at most

/// On the scale log(-log S), where a share between 0 and 1 is any number. `spread`: Greenwood's sum, the
/// variance of log S.
std::optional<Interval> log_log_interval(double survival, double spread) {
  if (survival <= 0 || survival >= 1) return {};
  const double factor = std::exp(normal_quantile() * std::sqrt(spread) / -std::log(survival));
  return Interval{std::pow(survival, factor), std::pow(survival, 1 / factor)};
}

}  // namespace

KaplanMeier::KaplanMeier(std::span<const Lifetime> lifetimes) {
  std::vector<Lifetime> sorted(lifetimes.begin(), lifetimes.end());
  std::sort(sorted.begin(), sorted.end(),
            [](const Lifetime& a, const Lifetime& b) { return a.time < b.time; });
  if (!sorted.empty()) follow_up_ = sorted.back().time;
  double survival = 1, spread = 0;
  for (std::size_t i = 0; i < sorted.size();) {
    const auto at_risk = static_cast<double>(sorted.size() - i);
    const double time = sorted[i].time;
    int events = 0;
    for (; i < sorted.size() && sorted[i].time == time; ++i) events += sorted[i].event ? 1 : 0;
    if (events == 0) continue;
    survival *= (at_risk - events) / at_risk;
    if (survival > 0) spread += events / (at_risk * (at_risk - events));
    steps_.push_back({time, survival, log_log_interval(survival, spread)});
  }
}

const KaplanMeier::Step* KaplanMeier::step_at(double time) const {
  const auto after = std::upper_bound(steps_.begin(), steps_.end(), time,
                                      [](double t, const Step& step) { return t < step.time; });
  return after == steps_.begin() ? nullptr : &*(after - 1);
}

double KaplanMeier::survival(double time) const {
  const Step* step = step_at(time);
  return step ? step->survival : 1;
}

std::optional<Interval> KaplanMeier::survival_interval(double time) const {
  const Step* step = step_at(time);
  return step ? step->interval : std::nullopt;
}

std::optional<double> KaplanMeier::time_until(double share) const {
  for (const Step& step : steps_)
    if (step.survival <= share + kRounding) return step.time;
  return {};
}

std::optional<Interval> KaplanMeier::time_until_interval(double share) const {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  Interval found{kNever, kNever};
  for (const Step& step : steps_) {
    if (!step.interval) continue;
    if (step.interval->low <= share) found.low = std::min(found.low, step.time);
    if (step.interval->high <= share) found.high = std::min(found.high, step.time);
  }
  if (found.low == kNever) return {};
  return found;
}

std::optional<double> KaplanMeier::probability_by(double time) const {
  if (time > follow_up_ && (steps_.empty() || steps_.back().survival > kRounding)) return {};
  return 1 - survival(time);
}

}  // namespace relock
