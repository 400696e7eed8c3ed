#pragma once

#include <array>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "eval/scores/blur_accuracy.h"
#include "eval/scores/tally.h"

namespace relock {

/// Time to recover from a loss: Kaplan-Meier over all losses, censored where they were not ended by a
/// recovery.
struct Recovery {
  std::size_t losses = 0;
  std::size_t recovered = 0;
  std::optional<double> median_s, p90_s;      ///< empty: beyond the follow-up
  std::optional<Interval> median_s_interval;  ///< of 95 %; an end that was never reached is infinite
  double follow_up_s = 0;                     ///< longest time a loss was watched
  /// Probability of recovery within 0.5, 1 and 5 s; empty past the follow-up unless no loss is left.
  std::array<std::optional<double>, 3> within;
};

/// The scores of metrics.md section 6 that rest on verdicts and events. An empty value is n/a.
struct Scores {
  std::array<std::size_t, kVerdicts> verdicts{};  ///< frames of each verdict; they add up to the frames
  std::size_t frames = 0;                         ///< recorded frames, times targets
  std::size_t uncoded = 0;                        ///< Hits by place of a method that reads codes
  std::size_t failed = 0;                         ///< Misses after a crash or time-out
  std::size_t spurious = 0;                       ///< sightings of nothing; only in pooled scores
  std::size_t ignored = 0;                        ///< sightings of what was not judged; only in pooled scores

  std::optional<double> recognition;            ///< Hits / visible frames not NotStarted, Given or Dropped
  std::optional<double> precision;              ///< Hits / all sightings that were judged
  std::optional<double> f1;                     ///< harmonic mean of the two
  std::optional<double> wrong_identity_rate;    ///< WrongId / (WrongId + Hit)
  std::optional<double> false_alarms_per_1000;  ///< frames without any target; only in pooled scores
  std::optional<double> spurious_per_minute;    ///< of recording; only in pooled scores
  double visible_s = 0;                         ///< visible time = locked + lost + searching
  double locked_s = 0, lost_s = 0, searching_s = 0;
  std::optional<double> availability;          ///< share of visible time with a Hit at most 0.1 s old
  std::optional<double> availability_ceiling;  ///< of a Hit on every frame that could have one
  std::optional<double> availability_of_ceiling;
  FixAge fix_age;
  std::optional<double> locked_share;
  std::optional<double> locked_share_ceiling;
  std::optional<double> locked_share_of_ceiling;
  std::size_t losses = 0;
  std::array<std::size_t, kLossKinds> losses_by_kind{};
  std::optional<double> losses_per_minute;           ///< of locked time
  std::optional<double> mean_time_between_losses_s;  ///< locked time / losses
  std::optional<double> silent_share;                ///< of lost time: a wrong answer was in force
  Recovery recovery;
  TrackingSurvivals survival;  ///< after every start or reset
  Localization localization;
  std::size_t own_labels = 0;  ///< frames that localization leaves out: the method made their labels
  std::map<std::string, std::size_t>
      labels;  ///< visible or absent, times targets, by their source (core/truth.h)
  BlurAccuracy blur;
  std::array<HitCount, kBlurBinCount> by_blur{};  ///< recognition apart by the length of the true blur
  std::array<HitCount, kGapBinCount> by_gap{};    ///< recognition apart by the gap before the frame
};

Scores scores_of(const Tally& tally);

/// Scores with frames and times of all targets pooled, and each target's own beside them.
struct ScoreSheet {
  Scores pooled;
  std::vector<Scores> targets;
};
ScoreSheet score(const Recording& recording, const Trajectory& trajectory, const Evaluation& evaluation);
/// From each target's tally.
ScoreSheet score(const Recording& recording, const Evaluation& evaluation,
                 std::span<const TargetTally> targets);

/// Recovery within these times is told, s.
constexpr std::array<double, 3> kRecoveredWithin_s{0.5, 1, 5};

}  // namespace relock
