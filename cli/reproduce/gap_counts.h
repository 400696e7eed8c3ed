#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/comparison.h"
#include "cli/reproduce/gap_arms.h"
#include "eval/scores/attribution.h"
#include "eval/scores/tracking_survival.h"

// What methods made of the arms of a flight (gap_arms.h), counted, and the arms compared flight by flight.

namespace relock::reproduction {

/// A flight as it was cut and shown.
struct GapCell {
  GapArm arm = GapArm::all_frames;
  bool blurred = false;  ///< the shutter open nearly all the time; else nearly none
  std::uint64_t seed = 1;
  friend bool operator==(const GapCell&, const GapCell&) = default;
};

/// What one method made of it.
struct GapCount {
  std::string method;
  GapCell cell;
  std::size_t frames = 0, losses = 0;
  std::size_t recovered = 0;  ///< losses that ended because the method found the target again
  /// Of the flight, not of the cut's clock: how long the method held the target.
  double held_minutes = 0;
  std::vector<Transition> steps = {};             ///< during which it might have been lost
  std::vector<TrackingLifetime> lifetimes = {};   ///< from each start on
  std::vector<std::optional<Vec2>> answers = {};  ///< of each frame: where the first sighting is

  double losses_per_minute() const { return static_cast<double>(losses) / held_minutes; }
};
/// Of every method but the yardsticks. The recording has one target.
std::vector<GapCount> counts_of(const ScoredComparison& runs, const GapCell& cell, const Cut& cut);

/// A mean over flights. They are independent, so the interval is Student's t; nothing of fewer than two.
struct FlightMean {
  double value = 0;
  std::optional<Interval> interval;
};
FlightMean mean_of(const std::vector<double>& flights);

/// Losses per minute held, in one cell after another of all the flights: by arm, [0] sharp and [1] blurred.
using LossRates = std::array<std::array<std::vector<double>, 2>, kGapArms.size()>;
/// Of one method. Every cell has the same flights in the same order, or is empty.
LossRates loss_rates(const std::vector<GapCount>& counts, const std::string& method);

/// What a factor adds to the losses per minute: main effects and interactions of the 2 x 2 x 2 of jump, pause and blur,
/// each the mean over the levels of the others, flight by flight.
struct GapEffects {
  FlightMean jump, pause, blur;
  FlightMean jump_with_pause;  ///< what the jump adds more where time passes, too, than where none does
  FlightMean jump_with_blur;   ///< and more where the pictures are blurred than where they are sharp
};
GapEffects effects_of(const LossRates& rates);

/// Steps of one kind, and those in which the target was lost.
struct StepRisk {
  std::size_t steps = 0, lost = 0;
};
/// By displacement over the step, in D: [edges[i], edges[i + 1]), the last without an end.
std::vector<StepRisk> risk_by_displacement(const std::vector<Transition>& steps,
                                           const std::vector<double>& edges);
/// Of the losses, and of all steps: those that span a gap longer than 0.1 s or are one of the two after one.
struct NearGap {
  StepRisk near, all;
};
NearGap near_gaps(const std::vector<Transition>& steps, Duration period);

}  // namespace relock::reproduction
