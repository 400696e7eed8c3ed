#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "eval/scores/contribution.h"
#include "eval/scores/fix_age.h"
#include "eval/scores/localization.h"
#include "eval/scores/tracking_survival.h"
#include "eval/statistics/kaplan_meier.h"

namespace relock {

/// Frames that could be Hits, and those that were.
struct HitCount {
  std::size_t could_hit = 0;
  std::size_t hits = 0;
};

/// Bins of the length of the true blur, px: up to each of these, then above, then where truth has none.
constexpr std::array<double, 5> kBlurBins_px{5, 10, 20, 40, 80};
/// Bins of slots since the last frame that was not Dropped: up to each of these, then above.
constexpr std::array<int, 4> kGapBins{1, 2, 4, 8};
constexpr std::size_t kBlurBinCount = kBlurBins_px.size() + 2, kGapBinCount = kGapBins.size() + 1;
/// Of each recorded frame.
std::vector<std::size_t> blur_bins(const Recording& recording, std::size_t target);
std::vector<std::size_t> gap_bins(const Recording& recording, std::span<const Judgement> judgements);
std::string_view blur_bin_name(std::size_t bin);
std::string_view gap_bin_name(std::size_t bin);

/// Lost time for which it is known what was said (metrics.md section 6).
struct LostTime {
  Duration told{0};      ///< an answer, or none, was in force
  Duration answered{0};  ///< of it: an answer, and a wrong one
};

/// What scores are made of. Tallies add up, over targets and over recordings.
struct Tally {
  std::size_t frames = 0;  ///< recorded frames, times targets
  std::array<std::size_t, kVerdicts> verdicts{};
  std::size_t uncoded = 0;  ///< Hits by place of a method that reads codes
  std::size_t failed = 0;   ///< Misses after a crash or time-out
  Contribution sum;
  LostTime lost;
  std::vector<Lifetime> losses;  ///< s, until recovery
  std::array<std::size_t, kLossKinds> losses_by_kind{};
  std::vector<TrackingLifetime> starts;  ///< of every Given, to its lock's end
  std::vector<Fix> fixes;
  std::size_t own_labels =
      0;  ///< frames that could be Hits, whose label stems from the method: localization leaves out
  std::map<std::string, std::size_t>
      labels;  ///< visible or absent, times targets, by their source (core/truth.h)
  std::vector<AgeStretch> ages;
  std::array<HitCount, kBlurBinCount> by_blur{};
  std::array<HitCount, kGapBinCount> by_gap{};

  // Of all targets together; zero in the tally of one.
  std::size_t spurious = 0;                  ///< sightings of nothing
  std::size_t ignored = 0;                   ///< sightings of what is not judged there
  Duration recorded{0};                      ///< from the first frame to one period after the last
  std::size_t frames_without_target = 0;     ///< frames whose every verdict is FalseAlarm or CorrectReject
  std::size_t sightings_without_target = 0;  ///< in those frames

  Tally& operator+=(const Tally& other);
};

/// Of one target: its tally, and what that adds up of each recorded frame.
struct TargetTally {
  std::vector<Contribution> frames;
  Tally tally;
};
TargetTally tally(const Recording& recording, const Trajectory& trajectory, const Evaluation& evaluation,
                  std::size_t target);
/// Of each target.
std::vector<TargetTally> tally_targets(const Recording& recording, const Trajectory& trajectory,
                                       const Evaluation& evaluation);

/// What belongs to all targets together: to be added to the sum of their tallies.
Tally tally_of_frames(const Recording& recording, const Evaluation& evaluation);

/// How long a loss was watched: from the early end of its onset to its end, whatever that was.
Duration loss_time(const Recording& recording, const Loss& loss);

}  // namespace relock
