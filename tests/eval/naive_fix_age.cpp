#include <algorithm>
#include <limits>

#include "tests/eval/naive_parts.h"

// How old the newest Hit is: metrics.md section 6.
namespace relock::naive {
namespace {

double in_seconds(Duration d) { return static_cast<double>(d.count()) * 1e-9; }

Duration total(const std::vector<Ageing>& ageings) {
  Duration sum{0};
  for (const Ageing& each : ageings) sum += each.length;
  return sum;
}

// Visible time at which the newest Hit is no older than `age`.
Duration time_not_older(const std::vector<Ageing>& ageings, Duration age) {
  Duration sum{0};
  for (const Ageing& each : ageings)
    if (each.from) sum += std::clamp(age - *each.from, Duration(0), each.length);
  return sum;
}

// The least age that is not exceeded for `percent` of visible time. Between the ages at which some stretch
// begins or ends, that time grows evenly.
double percentile(const std::vector<Ageing>& ageings, int percent) {
  std::vector<Duration> ages;
  for (const Ageing& each : ageings)
    if (each.from) ages.push_back(*each.from), ages.push_back(*each.from + each.length);
  std::sort(ages.begin(), ages.end());
  const auto reached = std::partition_point(ages.begin(), ages.end(), [&](Duration age) {
    return 100 * time_not_older(ageings, age) < percent * total(ageings);
  });
  if (reached == ages.end()) return std::numeric_limits<double>::infinity();
  // No stretch has time at its first age itself, so there is an age before the one that reaches it.
  const Duration high = *reached, low = *(reached - 1);
  const double at_low = in_seconds(time_not_older(ageings, low));
  const double at_high = in_seconds(time_not_older(ageings, high));
  const double part = (percent * in_seconds(total(ageings)) / 100 - at_low) / (at_high - at_low);
  return in_seconds(low) + part * in_seconds(high - low);
}

double oldest(const std::vector<Ageing>& ageings) {
  double age = 0;
  for (const Ageing& each : ageings)
    age = std::max(
        age, each.from ? in_seconds(*each.from + each.length) : std::numeric_limits<double>::infinity());
  return age;
}

}  // namespace

// Each visible interval is cut wherever a Hit falls inside it.
std::vector<Ageing> ageings(const std::vector<Interval>& visible, const std::vector<Time>& hits) {
  std::vector<Ageing> all;
  for (const Interval& each : visible) {
    std::vector<Time> cuts{each.from};
    for (const Time hit : hits)
      if (each.from < hit && hit < each.to) cuts.push_back(hit);
    cuts.push_back(each.to);
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      Ageing ageing{{}, cuts[i + 1] - cuts[i]};
      for (const Time hit : hits)
        if (hit <= cuts[i]) ageing.from = cuts[i] - hit;
      all.push_back(ageing);
    }
  }
  return all;
}

FixAge fix_age_of(const std::vector<Ageing>& ageings) {
  if (ageings.empty()) return {};
  return {percentile(ageings, 50), percentile(ageings, 95), oldest(ageings)};
}

}  // namespace relock::naive
