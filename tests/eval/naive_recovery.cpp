#include <algorithm>

#include "tests/eval/naive_parts.h"

// Time to recover, after Kaplan and Meier: metrics.md section 6.
namespace relock::naive {
namespace {

double in_seconds(Duration d) { return static_cast<double>(d.count()) * 1e-9; }

// Probability that a loss is not yet recovered just after `time`.
double still_lost(const std::vector<Watched>& losses, Duration time) {
  std::vector<Duration> events;
  for (const Watched& each : losses)
    if (each.recovered && each.time <= time) events.push_back(each.time);
  std::sort(events.begin(), events.end());
  events.erase(std::unique(events.begin(), events.end()), events.end());
  double survival = 1;
  for (const Duration event : events) {
    const auto at_risk =
        std::count_if(losses.begin(), losses.end(), [&](const Watched& w) { return w.time >= event; });
    const auto recovered = std::count_if(losses.begin(), losses.end(),
                                         [&](const Watched& w) { return w.recovered && w.time == event; });
    survival *= 1 - static_cast<double>(recovered) / static_cast<double>(at_risk);
  }
  return survival;
}

// The smallest time at which at most `share` of the losses are still lost.
std::optional<double> time_until(const std::vector<Watched>& losses, double share) {
  std::optional<double> first;
  for (const Watched& each : losses)
    if (still_lost(losses, each.time) <= share + 1e-12 && (!first || in_seconds(each.time) < *first))
      first = in_seconds(each.time);
  return first;
}

}  // namespace

Recovery recovery_of(const std::vector<Watched>& losses) {
  Recovery recovery;
  recovery.losses = losses.size();
  Duration follow_up{0};
  for (const Watched& each : losses) {
    recovery.recovered += each.recovered ? 1 : 0;
    follow_up = std::max(follow_up, each.time);
  }
  recovery.follow_up_s = in_seconds(follow_up);
  recovery.median_s = time_until(losses, 0.5);
  recovery.p90_s = time_until(losses, 0.1);
  const std::array<Duration, 3> limits{std::chrono::milliseconds(500), std::chrono::seconds(1),
                                       std::chrono::seconds(5)};
  const bool none_left = still_lost(losses, follow_up) <= 0;
  for (size_t i = 0; i < limits.size(); ++i)
    if (limits[i] <= follow_up || none_left) recovery.within[i] = 1 - still_lost(losses, limits[i]);
  return recovery;
}

}  // namespace relock::naive
