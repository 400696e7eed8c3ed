#include "eval/fix_age.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace relock {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kRounding = 1e-10;  // sums of up to a million stretches miss their whole by less, relatively

/// Where the share of time with an age of at most x rises by another slope.
struct Bend {
  double age_s;
  int slope;  // change of it: stretches that begin here less those that end
};

std::vector<Bend> bends_of(std::span<const AgeStretch> stretches) {
  std::vector<Bend> bends;
  for (const AgeStretch& stretch : stretches) {
    if (stretch.from_s == kNever) continue;
    bends.push_back({stretch.from_s, 1});
    bends.push_back({stretch.from_s + stretch.length_s, -1});
  }
  std::sort(bends.begin(), bends.end(), [](const Bend& a, const Bend& b) { return a.age_s < b.age_s; });
  return bends;
}

/// The least age that is not exceeded for `wanted_s` of the time.
double age_after(const std::vector<Bend>& bends, double wanted_s) {
  double reached = 0;
  std::int64_t slope = 0;
  for (std::size_t i = 0; i + 1 < bends.size(); ++i) {
    slope += bends[i].slope;
    const double rise = static_cast<double>(slope) * (bends[i + 1].age_s - bends[i].age_s);
    if (slope > 0 && reached + rise >= wanted_s * (1 - kRounding))
      return std::min(bends[i].age_s + (wanted_s - reached) / static_cast<double>(slope), bends[i + 1].age_s);
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
      stretches.push_back({next == 0 ? kNever : seconds(at - fixes[next - 1]), seconds(until - at)});
      at = until;
    }
  }
  return stretches;
}

FixAge fix_age(std::span<const AgeStretch> stretches) {
  double total = 0, finite = 0;
  for (const AgeStretch& stretch : stretches) {
    total += stretch.length_s;
    if (stretch.from_s != kNever) finite += stretch.length_s;
  }
  if (total <= 0) return {};
  const std::vector<Bend> bends = bends_of(stretches);
  const double oldest = finite < total * (1 - kRounding) || bends.empty() ? kNever : bends.back().age_s;
  const auto age = [&](double share) { return std::min(age_after(bends, share * total), oldest); };
  return {age(0.5), age(0.95), oldest};
}

}  // namespace relock
