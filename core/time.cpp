#include "core/time.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.h"

namespace relock {
namespace {

std::vector<Duration> intervals(std::span<const Time> captured) {
  if (captured.size() < 2) throw Error("a period needs at least two capture times; state the rate instead");
  std::vector<Duration> all;
  all.reserve(captured.size() - 1);
  for (std::size_t i = 1; i < captured.size(); ++i) all.push_back(captured[i] - captured[i - 1]);
  std::sort(all.begin(), all.end());
  return all;
}

/// Percentile by nearest rank of sorted values, `percent` in (0, 100].
Duration nearest_rank(std::span<const Duration> sorted, std::size_t percent) {
  const std::size_t rank = (percent * sorted.size() + 99) / 100;
  return sorted[rank - 1];
}

}  // namespace

Duration from_seconds(double s) { return Duration{std::llround(s * 1e9)}; }

Duration period_of(double rate_hz) { return from_seconds(1.0 / rate_hz); }

Duration nominal_period(std::span<const Time> captured) {
  const auto sorted = intervals(captured);
  const Duration p20 = nearest_rank(sorted, 20);
  // dt < 1.5 p20 in whole nanoseconds. With p20 = 0 (repeated times) nothing is shorter: the median serves.
  const auto end = std::find_if(sorted.begin(), sorted.end(), [&](Duration d) { return 2 * d >= 3 * p20; });
  const std::span<const Duration> shorter(sorted.begin(), end);
  return nearest_rank(shorter.empty() ? std::span<const Duration>(sorted) : shorter, 50);
}

Duration median_interval(std::span<const Time> captured) { return nearest_rank(intervals(captured), 50); }

std::vector<Time> reflected(std::span<const Time> captured) {
  std::vector<Time> turned;
  for (auto time = captured.rbegin(); time != captured.rend(); ++time)
    turned.push_back(captured.front() + (captured.back() - *time));
  return turned;
}

std::int64_t slots(Duration interval, Duration period) {
  const std::int64_t rounded = (2 * interval.count() + period.count()) / (2 * period.count());
  return std::max<std::int64_t>(1, rounded);
}

}  // namespace relock
