#pragma once

#include <optional>
#include <span>
#include <vector>

namespace relock {

/// How long something lasted: until its event, or until it was no longer watched (censored).
struct Lifetime {
  double time = 0;     ///< any unit, the same for all
  bool event = false;  ///< false: censored
};

/// The product-limit estimate of the share still without the event (Kaplan and Meier 1958). At equal times
/// events come before censorings.
class KaplanMeier {
 public:
  explicit KaplanMeier(std::span<const Lifetime> lifetimes);

  /// Share without the event just after `time`.
  double survival(double time) const;
  /// The earliest time at which at most `share` is left; nothing if that was never reached.
  std::optional<double> time_until(double share) const;
  /// Probability of the event by `time`; nothing past the follow-up unless none is left.
  std::optional<double> probability_by(double time) const;
  /// The longest lifetime, event or not; 0 without any.
  double follow_up() const { return follow_up_; }

 private:
  struct Step {
    double time;
    double survival;
  };
  std::vector<Step> steps_;
  double follow_up_ = 0;
};

}  // namespace relock
