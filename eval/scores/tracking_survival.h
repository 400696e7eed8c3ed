#pragma once

#include <optional>
#include <string>
#include <vector>

#include "eval/judgement/evaluation.h"
#include "eval/statistics/kaplan_meier.h"

namespace relock {

/// From one Given to the end of its lock (metrics.md section 6): until the last Hold before a loss (rule b: the
/// last Hit), or until the last Hold of a lock that ended otherwise: the target left, labels stopped, the next
/// Given or the end of the recording came. Then it is censored.
struct TrackingLifetime {
  std::size_t frames = 0;  ///< delivered frames after the Given
  double seconds = 0;
  bool lost = false;  ///< else censored
};

/// Of every Given of one target, in order.
std::vector<TrackingLifetime> tracking_lifetimes(const Recording& recording, const Trajectory& trajectory,
                                                 const TargetTimeline& timeline);

/// How long a method holds a target that it was given, over frames or over seconds.
struct TrackingSurvival {
  std::optional<double> median;             ///< nothing: beyond the follow-up
  std::optional<Interval> median_interval;  ///< an end that was never reached is infinite
  std::optional<double> at_claim;           ///< share that holds at the claim's time or later
  std::optional<Interval> at_claim_interval;
  double follow_up = 0;  ///< longest lifetime
};

struct TrackingSurvivals {
  std::size_t starts = 0, losses = 0;
  TrackingSurvival frames;   ///< claim: kClaimFrames
  TrackingSurvival seconds;  ///< claim: kClaimSeconds
};
/// Starts of several targets and runs pooled; they are taken for independent.
TrackingSurvivals tracking_survival(const std::vector<TrackingLifetime>& lifetimes);

/// The seed paper of its own tracker: it "fails again after about 100 frames", within 6 seconds.
constexpr double kClaimFrames = 100;
constexpr double kClaimSeconds = 6;

/// What the lifetimes say of that claim: both medians against both figures.
enum class ClaimVerdict : std::uint8_t {
  too_few,  ///< an interval of a median cannot be told, or has no upper end
  sooner,   ///< fails before 100 frames: the whole interval is below
  agrees,   ///< 100 frames lie in the interval, and 6 s or less do
  slower,   ///< 100 frames lie in the interval, but the whole interval of seconds is above 6 s
  longer,   ///< holds beyond 100 frames: the whole interval is above
};
ClaimVerdict judge_claim(const TrackingSurvivals& survival);

/// "fails after 87 frames [40, 160] or 4.1 s [2.0, 9.3] (median); 31 % [14, 51] still hold at 100 frames, 22 % [8,
/// 40] at 6 s (12 starts, 9 losses)".
std::string sentence(const TrackingSurvivals& survival);
/// "agrees", "fails sooner", …
std::string_view to_string(ClaimVerdict verdict);

}  // namespace relock
