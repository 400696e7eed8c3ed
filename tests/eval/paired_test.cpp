#include "eval/scores/paired.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/random.h"
#include "eval/scores/common_frames.h"
#include "eval/scores/scores.h"
#include "tests/eval/made_flight.h"
#include "tests/eval/random_timelines.h"

namespace relock {
namespace {

/// What a detector said; S is 30 px beside the target.
Trajectory beside(const Recording& recording, const std::string& letters) {
  return said(recording, letters, {0, 30});
}

GapCost cost(const Recording& recording, const std::string& without, const std::string& with) {
  const Trajectory a = beside(recording, without), b = beside(recording, with);
  return cost_of_gaps(std::vector<Pair>{{recording, a, b}});
}

Recording visible(std::size_t frames) { return made_flight(std::string(frames, 'v')); }

/// Outages that begin and end at random with every recorded frame, whether it comes or not.
std::string outages(Random& random, std::size_t frames) {
  std::string letters;
  for (bool out = false; letters.size() < frames; letters += out ? 'M' : 'H')
    out = out ? !random.chance(0.2) : random.chance(0.02);
  return letters;
}

/// Gaps of 4 slots, every 4 to 32 frames.
std::string with_gaps(Random& random, std::string letters) {
  for (std::size_t frame = 1; frame + 3 < letters.size(); frame += 4 * (random.below(8) + 1))
    letters.replace(frame, 3, "...");
  return letters;
}

/// The frames that came, as a recording of their own.
struct Alone {
  Recording recording;
  Trajectory trajectory;
};
Alone delivered_alone(const Recording& recording, const Trajectory& trajectory, Duration period) {
  Alone alone{recording, trajectory};
  alone.recording.period = period;
  alone.recording.captured.clear();
  alone.recording.truth.clear();
  alone.trajectory.frames.clear();
  std::vector<FrameIndex> rank;  // of the first frame kept from here on
  for (std::size_t frame = 0; frame < recording.frames(); ++frame) {
    rank.push_back(static_cast<FrameIndex>(alone.recording.frames()));
    if (trajectory.frames[frame].delivery != Delivery::delivered) continue;
    alone.recording.captured.push_back(recording.captured[frame]);
    for (std::size_t t = 0; t < recording.targets.size(); ++t)
      alone.recording.truth.push_back(recording.truth_of(frame, t));
    alone.trajectory.frames.push_back(trajectory.frames[frame]);
  }
  for (auto* from : {&alone.trajectory.judged_from, &alone.trajectory.failed_from})
    for (auto& frame : *from)
      if (frame) frame = rank[static_cast<std::size_t>(*frame)];
  return alone;
}

std::size_t losses_alone(const Recording& recording, const std::string& letters) {
  const Trajectory arm = beside(recording, letters);
  const Alone alone = delivered_alone(recording, arm, recording.period);
  return evaluate(alone.recording, alone.trajectory).targets[0].losses.size();
}

struct Mean {
  double sum = 0, squares = 0, n = 0;
  void add(double value) { sum += value, squares += value * value, ++n; }
  double value() const { return sum / n; }
  double standard_error() const { return std::sqrt((squares / n - value() * value()) / n); }
};

/// What was found in many pairs of a method that loses the target when it will, gaps or not.
struct IndifferentMethod {
  std::array<Mean, kCostScores> difference, covered;
  Mean losses, naive_losses;
};
const IndifferentMethod& indifferent_method() {
  static const IndifferentMethod found = [] {
    constexpr std::size_t kFrames = 1000;
    const Recording recording = visible(kFrames);
    IndifferentMethod all;
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
      Random random(seed);
      const std::string without = outages(random, kFrames);
      const std::string with = with_gaps(random, outages(random, kFrames));
      const GapCost pair = cost(recording, without, with);
      for (std::size_t i = 0; i < kCostScores; ++i) {
        all.difference[i].add(pair.scores[i].difference.value());
        if (const auto& interval = pair.scores[i].interval)
          all.covered[i].add(interval->low <= 0 && interval->high >= 0 ? 1 : 0);
      }
      all.losses.add(static_cast<double>(pair.losses_with) - static_cast<double>(pair.losses_without));
      all.naive_losses.add(static_cast<double>(losses_alone(recording, with)) -
                           static_cast<double>(losses_alone(recording, without)));
    }
    return all;
  }();
  return found;
}
constexpr std::array kShares{CostScore::recognition, CostScore::locked_share, CostScore::availability,
                             CostScore::losses_per_minute};

TEST(CostOfGaps, IsZeroInExpectationWhenOutagesIgnoreDelivery) {
  for (const CostScore score : kShares) {
    const Mean& mean = indifferent_method().difference[static_cast<std::size_t>(score)];
    EXPECT_LT(std::abs(mean.value()), 2.6 * mean.standard_error()) << to_string(score);
  }
  const Mean& losses = indifferent_method().losses;
  EXPECT_LT(std::abs(losses.value()), 2.6 * losses.standard_error());
}

TEST(CostOfGaps, LooksLikeAGainWhenEachArmIsScoredOnItsOwnFrames) {
  const Mean& losses = indifferent_method().naive_losses;
  EXPECT_LT(losses.value(), -1);
  EXPECT_LT(losses.value(), -4 * losses.standard_error());
}

TEST(CostOfGaps, IsCoveredByItsIntervalAsOftenAsThatSays) {
  for (const CostScore score : kShares) {
    const Mean& covered = indifferent_method().covered[static_cast<std::size_t>(score)];
    EXPECT_GT(covered.n, 270) << to_string(score);
    EXPECT_GT(covered.value(), 0.91) << to_string(score);  // 0.95, give or take 0.0126
    EXPECT_LT(covered.value(), 0.99) << to_string(score);
  }
}

TEST(CostOfGaps, IsExactlyZeroWhenNothingWasDropped) {
  const Recording recording = visible(300);
  Random random(4);
  const std::string letters = outages(random, 300);
  const GapCost pair = cost(recording, letters, letters);
  EXPECT_EQ(pair.common_frames, 300u);
  EXPECT_EQ(pair.losses_with, pair.losses_without);
  for (const PairedScore& score : pair.scores) {
    EXPECT_EQ(score.difference, 0.0);
    EXPECT_EQ(score.with, score.without);
  }
  EXPECT_EQ(pair.recorded_availability_with, pair.recorded_availability_without);
}

TEST(CostOfGaps, IsWhatAMethodWasBuiltToLoseAfterEveryGap) {
  Random random(3);
  std::string with(8, 'H');
  for (int gap = 0; gap < 40; ++gap) with += "...MMMMM" + std::string(8 + random.below(24), 'H');
  const std::string without(with.size(), 'H');
  const double frames = static_cast<double>(with.size());
  const GapCost pair = cost(visible(with.size()), without, with);
  EXPECT_EQ(pair.common_frames, with.size() - 40 * 3);
  EXPECT_EQ(pair.losses_without, 0u);
  EXPECT_EQ(pair.losses_with, 40u);
  EXPECT_NEAR(pair[CostScore::recognition].difference.value(), -40 * 5 / (frames - 40 * 3), 1e-12);
  // From the last Hold before a gap to the first Hit after it are 9 slots, of one slot less than there are frames.
  EXPECT_NEAR(pair[CostScore::locked_share].difference.value(), -40 * 9 / (frames - 1), 1e-9);
  for (const CostScore score : {CostScore::recognition, CostScore::locked_share, CostScore::availability,
                                CostScore::losses_per_minute}) {
    EXPECT_EQ(verdict_on(score, pair[score].interval), -1)
        << to_string(score) << " in [" << pair[score].interval.value_or(Interval{}).low << ", "
        << pair[score].interval.value_or(Interval{}).high << "]";
  }
}

TEST(CostOfGaps, LeavesTheAgeOfFixesToTheAvailabilityOnAllRecordedFrames) {
  const std::string without(300, 'H');
  std::string with;
  for (int n = 0; n < 30; ++n) with += "HHHH.....H";  // a Hit on every frame that came
  const GapCost pair = cost(visible(300), without, with);
  EXPECT_EQ(pair[CostScore::availability].difference, 0.0);
  EXPECT_NEAR(pair.recorded_availability_without.value(), 1, 1e-9);
  EXPECT_NEAR(pair.recorded_availability_with.value(), 0.7, 0.01);
}

TEST(CostOfGaps, OfErrorsIsTakenOverHitsOfBothArmsOnTheSameFrame) {
  const Recording recording = visible(9);
  Trajectory without = beside(recording, "HHHHHHHHH"), with = beside(recording, "HHH.HSMHH");
  for (FrameReport& report : without.frames) report.sightings.front().centre.x += 1;
  for (const std::size_t frame : {0u, 1u, 2u, 4u, 7u, 8u}) with.frames[frame].sightings.front().centre.x += 3;
  without.frames[5].sightings.front().centre.x += 8;  // no Hit in the other arm
  const GapCost pair = cost_of_gaps(std::vector<Pair>{{recording, without, with}});
  EXPECT_NEAR(pair[CostScore::error_px].without.value(), 1, 1e-9);
  EXPECT_NEAR(pair[CostScore::error_px].with.value(), 3, 1e-9);
}

TEST(CostOfGaps, PoolsSequencesAndSeedsFrameByFrame) {
  Recording first = visible(200), second = visible(200);
  second.name = "other";
  Random random(11);
  std::vector<Trajectory> arms;
  for (int n = 0; n < 3; ++n) {
    arms.push_back(beside(first, outages(random, 200)));
    arms.push_back(beside(first, with_gaps(random, outages(random, 200))));
  }
  const std::vector<Pair> pairs{
      {first, arms[0], arms[1]}, {first, arms[2], arms[3]}, {second, arms[4], arms[5]}};
  const GapCost pooled = cost_of_gaps(pairs);
  double hits = 0, frames = 0, losses = 0;
  for (const Pair& pair : pairs) {
    const CommonFrames both = common_frames(pair.recording, pair.without, pair.with);
    const Scores scores = score(both.recording, both.with, evaluate(both.recording, both.with)).pooled;
    const double could = static_cast<double>(scores.verdicts[static_cast<std::size_t>(Verdict::Hit)] +
                                             scores.verdicts[static_cast<std::size_t>(Verdict::Miss)]);
    hits += scores.recognition.value() * could;
    frames += could;
    losses += static_cast<double>(scores.losses);
  }
  EXPECT_EQ(pooled.pairs, 3u);
  EXPECT_NEAR(pooled[CostScore::recognition].with.value(), hits / frames, 1e-12);
  EXPECT_EQ(static_cast<double>(pooled.losses_with), losses);
}

TEST(CostOfGaps, HasTheScoresOfRelockScoreOnTheCommonFrames) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const Case drawn = random_case(seed);
    const CommonFrames both = common_frames(drawn.recording, drawn.trajectory, drawn.trajectory);
    if (both.common.empty()) continue;
    const Scores expected = score(both.recording, both.with, evaluate(both.recording, both.with)).pooled;
    const GapCost pair =
        cost_of_gaps(std::vector<Pair>{{drawn.recording, drawn.trajectory, drawn.trajectory}});
    const auto same = [&](CostScore which, const std::optional<double>& value) {
      ASSERT_EQ(pair[which].with.has_value(), value.has_value()) << to_string(which) << " seed " << seed;
      EXPECT_NEAR(pair[which].with.value_or(0), value.value_or(0), 1e-9)
          << to_string(which) << " seed " << seed;
    };
    same(CostScore::recognition, expected.recognition);
    same(CostScore::locked_share, expected.locked_share);
    same(CostScore::availability, expected.availability);
    same(CostScore::losses_per_minute, expected.losses_per_minute);
    EXPECT_EQ(pair.losses_with, expected.losses);
  }
}

TEST(CommonFrames, AreJudgedAsIfTheOthersHadNeverBeenRecorded) {
  const Recording recording = visible(400);
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    Random random(seed);
    const Trajectory without = beside(recording, outages(random, 400));
    const Trajectory with = beside(recording, with_gaps(random, outages(random, 400)));
    const CommonFrames both = common_frames(recording, without, with);
    for (const Trajectory* arm : {&both.without, &both.with}) {
      const Alone alone = delivered_alone(both.recording, *arm, nominal_period([&] {
                                            std::vector<Time> captured;
                                            for (std::size_t f = 0; f < both.common.size(); ++f)
                                              if (both.common[f]) captured.push_back(recording.captured[f]);
                                            return captured;
                                          }()));
      const Scores kept = score(both.recording, *arm, evaluate(both.recording, *arm)).pooled;
      const Scores renumbered =
          score(alone.recording, alone.trajectory, evaluate(alone.recording, alone.trajectory)).pooled;
      EXPECT_EQ(kept.recognition, renumbered.recognition);
      EXPECT_EQ(kept.losses, renumbered.losses);
      EXPECT_NEAR(kept.visible_s, renumbered.visible_s, 1e-9);
      EXPECT_NEAR(kept.locked_s, renumbered.locked_s, 1e-9);
      EXPECT_NEAR(kept.lost_s, renumbered.lost_s, 1e-9);
      EXPECT_NEAR(kept.availability.value(), renumbered.availability.value(), 1e-9);
      EXPECT_EQ(kept.recovery.median_s, renumbered.recovery.median_s);
    }
  }
}

TEST(CommonFrames, HaveTheirOwnPeriodWhateverWasStated) {
  Recording recording = visible(60);
  std::string with;
  for (int n = 0; n < 20; ++n) with += "H..";
  const CommonFrames both =
      common_frames(recording, beside(recording, std::string(60, 'H')), beside(recording, with));
  EXPECT_EQ(both.recording.period, 3 * recording.period);
}

/// How the one loss ends, on frames common to both arms, of a method that loses the target before the labels
/// end and has it again after; `with`: which frames came in the other arm.
LossEnd end_of_loss(const std::string& labels, const std::string& delivered) {
  const Recording recording = made_flight(labels);
  std::string without;
  for (std::size_t frame = 0; frame < labels.size(); ++frame)
    without += labels[frame] != 'v' || (frame >= 27 && frame < 30) ? 'M' : 'H';
  std::string with = without;
  for (std::size_t frame = 0; frame < labels.size(); ++frame)
    if (delivered[frame] == '.') with[frame] = '.';
  const CommonFrames both = common_frames(recording, beside(recording, without), beside(recording, with));
  const auto losses = evaluate(both.recording, both.with).targets[0].losses;
  return losses.size() == 1 ? losses[0].end : LossEnd::reset;
}

TEST(CommonFrames, StopLabelsWhereTheyStopOnAllRecordedFrames) {
  const std::string before(30, 'v'), after(20, 'v');
  const std::string stopped = before + std::string(20, '?') + after;
  EXPECT_EQ(end_of_loss(stopped, std::string(70, 'd')), LossEnd::labels_stopped);
  EXPECT_EQ(end_of_loss(stopped, std::string(30, 'd') + std::string(20, '.') + std::string(20, 'd')),
            LossEnd::labels_stopped)
      << "the unlabelled frames came in one arm only";
  const std::string going_on = before + "?????v?????v????v" + after;
  EXPECT_EQ(end_of_loss(going_on, std::string(31, 'd') + std::string(16, '.') + std::string(20, 'd')),
            LossEnd::recovered)
      << "the labelled frames between came in one arm only";
}

TEST(CommonFrames, EndBeforeTheFirstResetOfEitherArm) {
  const Recording recording = visible(40);
  Trajectory without = beside(recording, std::string(40, 'H')), with = without;
  without.frames[0].given = with.frames[0].given = {0};
  EXPECT_FALSE(common_frames(recording, without, with).ends_at_reset);
  without.frames[30].given = {0};
  with.frames[25].given = {0};
  const CommonFrames both = common_frames(recording, without, with);
  EXPECT_TRUE(both.ends_at_reset);
  EXPECT_EQ(both.recording.frames(), 25u);
  EXPECT_EQ(both.without.frames.size(), 25u);
}

TEST(CommonFrames, DoNotTakeALateFirstStartForAReset) {
  const Recording recording = visible(40);
  Trajectory without = beside(recording, std::string(40, 'H')), with = without;
  without.frames[2].given = {0};  // it was busy with another target on frame 0, from which this one is judged
  with.frames[5].given = {0};
  const CommonFrames both = common_frames(recording, without, with);
  EXPECT_FALSE(both.ends_at_reset);
  EXPECT_EQ(both.recording.frames(), 40u);
  with.frames[30].given = {0};
  EXPECT_EQ(frames_before_reset(without, with), 30u);
}

}  // namespace
}  // namespace relock
