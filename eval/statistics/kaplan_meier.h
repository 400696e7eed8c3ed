#pragma once

#include <optional>
#include <span>
#include <vector>

#include "eval/statistics/interval.h"

namespace relock {

/// How long something lasted: until its event, or until it was no longer watched (censored).
struct Lifetime {
  double time = 0;     ///< any unit, the same for all
  bool event = false;  ///< false: censored
};

/// The product-limit estimate of the share still without the event (Kaplan and Meier 1958). At equal times
/// events come before censorings.
///
/// Intervals are of 95 %, from Greenwood's variance on the scale log(-log S), as R's survfit has them with
/// conf.type = "log-log". They take the lifetimes for independent.
class KaplanMeier {
 public:
  explicit KaplanMeier(std::span<const Lifetime> lifetimes);

  /// Share without the event just after `time`.
  double survival(double time) const;
  /// Of that share; nothing while it is 1 or once it is 0, where Greenwood's variance is none.
  std::optional<Interval> survival_interval(double time) const;
  /// The earliest time at which at most `share` is left; nothing if that was never reached.
  std::optional<double> time_until(double share) const;
  /// Of that time: all times at which the interval of the share left holds `share` (Brookmeyer and Crowley
  /// 1982). An end that was never reached is infinite; nothing when both are.
  std::optional<Interval> time_until_interval(double share) const;
  /// Probability of the event by `time`; nothing past the follow-up unless none is left.
  std::optional<double> probability_by(double time) const;
  /// The longest lifetime, event or not; 0 without any.
  double follow_up() const { return follow_up_; }

 private:
  struct Step {
    double time;
    double survival;
    std::optional<Interval> interval;
  };
  const Step* step_at(double time) const;

  std::vector<Step> steps_;
  double follow_up_ = 0;
};

}  // namespace relock
