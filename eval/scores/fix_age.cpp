#include "eval/scores/fix_age.h"

#include <algorithm>
#include <limits>

namespace relock {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Where the time with an age of at most x rises by another slope.
struct Bend {
  Duration age;
  int slope;  // change of it: stretches that begin here less those that end
};

std::vector<Bend> bends_of(std::span<const AgeStretch> stretches) {
  std::vector<Bend> bends;
  for (const AgeStretch& stretch : stretches) {
    if (!stretch.from) continue;
    bends.push_back({*stretch.from, 1});
    bends.push_back({*stretch.from + stretch.length, -1});
  }
  std::sort(bends.begin(), bends.end(), [](const Bend& a, const Bend& b) { return a.age < b.age; });
  return bends;
}

/// The least age, s, that is not exceeded for `percent` of the `total` time.
double age_after(const std::vector<Bend>& bends, int percent, Duration total) {
  Duration reached{0};
  std::int64_t slope = 0;
  for (std::size_t i = 0; i + 1 < bends.size(); ++i) {
    slope += bends[i].slope;
    const Duration rise = slope * (bends[i + 1].age - bends[i].age);
    if (rise > Duration(0) && 100 * (reached + rise) >= percent * total) {
      const Duration hundredfold = percent * total - 100 * reached;
      return seconds(bends[i].age) + seconds(hundredfold) / (100 * static_cast<double>(slope));
    }
    reached += rise;
  }
  return kNever;
}

}  // namespace

std::vector<AgeStretch> fix_ages(std::span<const VisibleInterval> visible, std::span<const Time> fixes) {
  std::vector<AgeStretch> stretches;
  std::size_t next = 0;  // the first fix after the time looked at
  for (const VisibleInterval& interval : visible) {
    Time at = interval.from;
    while (at < interval.to) {
      while (next < fixes.size() && fixes[next] <= at) ++next;
      const Time until = next < fixes.size() ? std::min(interval.to, fixes[next]) : interval.to;
      stretches.push_back({next == 0 ? std::nullopt : std::optional(at - fixes[next - 1]), until - at});
      at = until;
    }
  }
  return stretches;
}

FixAge fix_age(std::span<const AgeStretch> stretches) {
  Duration total{0};
  bool always = true;
  for (const AgeStretch& stretch : stretches) {
    total += stretch.length;
    always = always && stretch.from;
  }
  if (total <= Duration(0)) return {};
  const std::vector<Bend> bends = bends_of(stretches);
  return {age_after(bends, 50, total), age_after(bends, 95, total),
          always ? seconds(bends.back().age) : kNever};
}

}  // namespace relock
