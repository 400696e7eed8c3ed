#include "eval/scores/tracking_survival.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace relock {
namespace {

/// The last frame of the lock that begins at the Given `start`, and whether it was lost there.
struct LockEnd {
  std::size_t frame = 0;
  bool lost = false;
};

LockEnd lock_end(const TargetTimeline& timeline, std::size_t start) {
  const auto& judgements = timeline.judgements;
  const auto given = [&](std::size_t frame) { return judgements[frame].verdict == Verdict::Given; };
  std::size_t last = start;
  // A state is in force from its frame to the next, and Lost from the last good frame on.
  while (timeline.states[last] == State::Locked && last + 1 < judgements.size() && !given(last + 1)) ++last;
  const bool lost = std::any_of(timeline.losses.begin(), timeline.losses.end(), [&](const Loss& loss) {
    return loss.last_good == static_cast<FrameIndex>(last);
  });
  while (!lost && last > start && !judgements[last].hold) --last;
  return {last, lost};
}

TrackingSurvival survival_of(const std::vector<Lifetime>& lifetimes, double claim) {
  const KaplanMeier estimate(lifetimes);
  TrackingSurvival found;
  found.median = estimate.time_until(0.5);
  found.median_interval = estimate.time_until_interval(0.5);
  found.follow_up = estimate.follow_up();
  // Who fails after a Hold at the claim's very time has survived it: the share just before is asked for.
  const double before = std::nextafter(claim, 0.0);
  const auto failed = estimate.probability_by(before);
  if (failed && !lifetimes.empty()) {
    found.at_claim = 1 - *failed;
    found.at_claim_interval = estimate.survival_interval(before);
  }
  return found;
}

std::string limits(const std::optional<Interval>& interval, double scale, int decimals) {
  if (!interval) return {};
  const auto text = [&](double v) {
    return std::isinf(v) ? "more" : fmt::format("{:.{}f}", v * scale, decimals);
  };
  return fmt::format(" [{}, {}]", text(interval->low), text(interval->high));
}

std::string share(const TrackingSurvival& s, std::string_view at) {
  return fmt::format("{:.0f} %{} still hold at {}", 100 * *s.at_claim, limits(s.at_claim_interval, 100, 0),
                     at);
}

/// Both shares, or what cannot be told of them.
std::string shares(const TrackingSurvivals& survival) {
  const std::string frames = fmt::format("{:.0f} frames", kClaimFrames);
  const std::string time = fmt::format("{:.0f} s", kClaimSeconds);
  const bool frames_known = survival.frames.at_claim.has_value(),
             time_known = survival.seconds.at_claim.has_value();
  if (frames_known && time_known)
    return fmt::format("{}, {}", share(survival.frames, frames), share(survival.seconds, time));
  if (frames_known)
    return fmt::format("{}, {} are beyond the follow-up", share(survival.frames, frames), time);
  if (time_known)
    return fmt::format("{}, {} are beyond the follow-up", share(survival.seconds, time), frames);
  return fmt::format("{} and {} are beyond the follow-up", frames, time);
}

std::string plural(std::size_t n, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", n, n == 1 ? one : many);
}

}  // namespace

std::vector<TrackingLifetime> tracking_lifetimes(const Recording& recording, const Trajectory& trajectory,
                                                 const TargetTimeline& timeline) {
  std::vector<TrackingLifetime> found;
  for (std::size_t start = 0; start < timeline.judgements.size(); ++start) {
    if (timeline.judgements[start].verdict != Verdict::Given) continue;
    const LockEnd end = lock_end(timeline, start);
    TrackingLifetime& lifetime = found.emplace_back();
    for (std::size_t frame = start + 1; frame <= end.frame; ++frame)
      lifetime.frames += trajectory.frames[frame].delivery == Delivery::delivered ? 1 : 0;
    lifetime.seconds = seconds(recording.captured[end.frame] - recording.captured[start]);
    lifetime.lost = end.lost;
  }
  return found;
}

TrackingSurvivals tracking_survival(const std::vector<TrackingLifetime>& lifetimes) {
  TrackingSurvivals found;
  std::vector<Lifetime> frames, times;
  for (const TrackingLifetime& one : lifetimes) {
    frames.push_back({static_cast<double>(one.frames), one.lost});
    times.push_back({one.seconds, one.lost});
    found.losses += one.lost ? 1 : 0;
  }
  found.starts = lifetimes.size();
  found.frames = survival_of(frames, kClaimFrames);
  found.seconds = survival_of(times, kClaimSeconds);
  return found;
}

ClaimVerdict judge_claim(const TrackingSurvivals& survival) {
  const auto& frames = survival.frames.median_interval;
  const auto& time = survival.seconds.median_interval;
  if (!frames || !time) return ClaimVerdict::too_few;
  if (frames->high < kClaimFrames) return ClaimVerdict::sooner;
  if (frames->low > kClaimFrames) return ClaimVerdict::longer;
  if (std::isinf(frames->high) || std::isinf(time->high)) return ClaimVerdict::too_few;
  return time->low <= kClaimSeconds ? ClaimVerdict::agrees : ClaimVerdict::slower;
}

std::string sentence(const TrackingSurvivals& survival) {
  if (survival.starts == 0) return "was never given the target";
  const auto& [starts, losses, frames, time] = survival;
  const std::string counted =
      fmt::format("({}, {})", plural(starts, "start", "starts"), plural(losses, "loss", "losses"));
  const std::string fails =
      frames.median && time.median
          ? fmt::format("fails after {:.0f} frames{} or {:.1f} s{} (median)", *frames.median,
                        limits(frames.median_interval, 1, 0), *time.median,
                        limits(time.median_interval, 1, 1))
          : fmt::format("holds beyond the follow-up of {:.0f} frames or {:.1f} s (median)", frames.follow_up,
                        time.follow_up);
  return fmt::format("{}; {} {}", fails, shares(survival), counted);
}

std::string_view to_string(ClaimVerdict verdict) {
  switch (verdict) {
    case ClaimVerdict::too_few:
      return "too few losses to tell";
    case ClaimVerdict::sooner:
      return "fails sooner";
    case ClaimVerdict::agrees:
      return "agrees";
    case ClaimVerdict::slower:
      return "agrees on frames, but takes longer than 6 s";
    case ClaimVerdict::longer:
      return "holds longer";
  }
  return "";
}

}  // namespace relock
