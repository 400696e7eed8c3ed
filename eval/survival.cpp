#include "eval/survival.h"

#include <algorithm>

namespace relock {
namespace {
constexpr double kRounding =
    1e-12;  // products of exact fractions, as 3/4 · 2/3, miss 1/2 by this much at most
}

KaplanMeier::KaplanMeier(std::span<const Lifetime> lifetimes) {
  std::vector<Lifetime> sorted(lifetimes.begin(), lifetimes.end());
  std::sort(sorted.begin(), sorted.end(),
            [](const Lifetime& a, const Lifetime& b) { return a.time < b.time; });
  if (!sorted.empty()) follow_up_ = sorted.back().time;
  double survival = 1;
  for (std::size_t i = 0; i < sorted.size();) {
    const auto at_risk = static_cast<double>(sorted.size() - i);
    const double time = sorted[i].time;
    int events = 0;
    for (; i < sorted.size() && sorted[i].time == time; ++i) events += sorted[i].event ? 1 : 0;
    if (events == 0) continue;
    survival *= (at_risk - events) / at_risk;
    steps_.push_back({time, survival});
  }
}

double KaplanMeier::survival(double time) const {
  double left = 1;
  for (const Step& step : steps_) {
    if (step.time > time) break;
    left = step.survival;
  }
  return left;
}

std::optional<double> KaplanMeier::time_until(double share) const {
  for (const Step& step : steps_)
    if (step.survival <= share + kRounding) return step.time;
  return {};
}

std::optional<double> KaplanMeier::probability_by(double time) const {
  if (time > follow_up_ && (steps_.empty() || steps_.back().survival > kRounding)) return {};
  return 1 - survival(time);
}

}  // namespace relock
