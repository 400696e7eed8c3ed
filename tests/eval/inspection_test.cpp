#include "eval/inspection/inspection.h"

#include <gtest/gtest.h>

#include <numeric>

#include "core/random.h"
#include "eval/definitions.h"

namespace relock {
namespace {

constexpr std::int64_t kT = 33'000'000;

/// A recording with frames at these slots, one target of 20 px that moves 5 px to the right each frame.
Recording at_slots(const std::vector<std::int64_t>& slots) {
  Recording recording;
  recording.name = "made up";
  recording.picture = {640, 480};
  recording.period = Duration(kT);
  recording.targets = {{"ball"}};
  for (std::size_t i = 0; i < slots.size(); ++i) {
    recording.captured.push_back(time_ns(slots[i] * kT));
    TargetTruth truth;
    truth.label = Label::visible;
    truth.outline = Box{100.0 + 5.0 * static_cast<double>(i), 100, 20, 20};
    recording.truth.push_back(truth);
  }
  return recording;
}

TEST(Inspection, CountsEveryIntervalOnceWhateverTheGaps) {
  Random random(3);
  for (int round = 0; round < 50; ++round) {
    std::vector<std::int64_t> slots{0};
    while (slots.size() < 40)
      slots.push_back(slots.back() + 1 +
                      static_cast<std::int64_t>(random.chance(0.3) ? random.below(60) : 0));
    const Recording recording = at_slots(slots);
    const IntervalInspection in = inspect(recording).intervals;
    EXPECT_EQ(std::accumulate(in.histogram.begin(), in.histogram.end(), std::size_t{0}), 39u);
    EXPECT_EQ(std::accumulate(in.slots.begin(), in.slots.end(), std::int64_t{0}), slots.back());
    EXPECT_EQ(in.gaps + in.histogram[0], 39u);
  }
}

TEST(Inspection, TellsAGapOfFourSlotsAndWhere) {
  const IntervalInspection in = inspect(at_slots({0, 1, 2, 6, 7, 8})).intervals;
  EXPECT_EQ(in.histogram[3], 1u);
  EXPECT_EQ(in.gaps, 1u);
  EXPECT_EQ(in.longest_gap_before, FrameIndex{3});
  EXPECT_DOUBLE_EQ(*in.missing_share, 3.0 / 8);
}

TEST(Inspection, LeavesPausesOutOfTheMissingSlots) {
  const IntervalInspection in = inspect(at_slots({0, 1, 2, 1002, 1003})).intervals;
  EXPECT_EQ(in.pauses, std::vector<FrameIndex>{3});
  EXPECT_DOUBLE_EQ(*in.missing_share, 0);
}

TEST(Inspection, FindsNoJitterInExactTimesAndTheOneThatWasPutIn) {
  Recording recording = at_slots({0, 1, 2, 3, 6, 7});
  EXPECT_DOUBLE_EQ(inspect(recording).intervals.jitter->deviation_ms, 0);
  EXPECT_DOUBLE_EQ(inspect(recording).intervals.jitter->largest_ms, 0);
  recording.captured[2] += std::chrono::milliseconds(4);
  const Jitter jitter = *inspect(recording).intervals.jitter;
  EXPECT_NEAR(jitter.largest_ms, 4, 1e-9);
  EXPECT_EQ(jitter.largest_at, 2);
  EXPECT_EQ(jitter.intervals, 4u);
}

TEST(Inspection, IsTheSameWhenAllTimesAreShifted) {
  Recording recording = at_slots({0, 1, 2, 6, 7, 300, 301});
  recording.truth[1].label = Label::unlabelled;
  recording.captured[1] += std::chrono::milliseconds(3);
  const Inspection before = inspect(recording);
  for (Time& time : recording.captured) time += std::chrono::hours(400'000);
  const Inspection after = inspect(recording);
  EXPECT_EQ(before.intervals.slots, after.intervals.slots);
  EXPECT_EQ(before.intervals.pauses, after.intervals.pauses);
  EXPECT_EQ(before.intervals.longest_gap_before, after.intervals.longest_gap_before);
  EXPECT_DOUBLE_EQ(before.intervals.jitter->deviation_ms, after.intervals.jitter->deviation_ms);
  EXPECT_EQ(before.targets[0].longest_unlabelled, after.targets[0].longest_unlabelled);
  EXPECT_EQ(before.targets[0].seen_for, after.targets[0].seen_for);
  EXPECT_DOUBLE_EQ(before.targets[0].step_d->most, after.targets[0].step_d->most);
}

TEST(Inspection, MeasuresStepsInSizesOfTheTarget) {
  Recording recording = at_slots({0, 1, 2, 3, 4});
  recording.truth[3].outline = Box{130, 100, 20, 20};
  const TargetInspection in = inspect(recording).targets[0];
  EXPECT_DOUBLE_EQ(in.step_d->median, (0.25 + 0.5) / 2);
  EXPECT_DOUBLE_EQ(in.step_d->most, 1.0);
  EXPECT_EQ(in.step_d->most_at, 3);
  EXPECT_DOUBLE_EQ(in.size_px->median, 20);
}

TEST(Inspection, TakesNoStepOverAPauseOrAFrameThatIsNotVisible) {
  Recording recording = at_slots({0, 1, 2, 1000});
  recording.truth[1].label = Label::absent;
  const TargetInspection in = inspect(recording).targets[0];
  EXPECT_FALSE(in.step_d);
  EXPECT_EQ(in.departures, 1u);
  EXPECT_EQ(in.returns, 1u);
}

TEST(Inspection, OfLabelsAddsUpToTheFrames) {
  Recording recording = at_slots({0, 1, 2, 3, 4, 5});
  recording.truth[0].label = recording.truth[5].label = Label::absent;
  recording.truth[2].label = recording.truth[3].label = Label::unlabelled;
  const TargetInspection in = inspect(recording).targets[0];
  EXPECT_EQ(in.visible + in.absent + in.unlabelled, 6u);
  EXPECT_EQ(in.first_startable, FrameIndex{1});
  EXPECT_EQ(*in.longest_unlabelled, Duration(3 * kT));
  EXPECT_EQ(in.departures, 1u);
  EXPECT_EQ(in.returns, 1u);
}

TEST(Inspection, OfOneFrameHasNoIntervalsAndNoJitter) {
  const Inspection found = inspect(at_slots({0}));
  EXPECT_TRUE(found.intervals.slots.empty());
  EXPECT_FALSE(found.intervals.jitter || found.intervals.missing_share || found.targets[0].step_d);
}

TEST(BlurSummary, IsWithheldWhenMostFramesWereDeclined) {
  std::vector<BlurOfFrame> frames{{0, BlurEstimate{0, 8}, 40.0}, {1, BlurEstimate{}, 40.0}};
  EXPECT_DOUBLE_EQ(summarise(frames).length_px->most, 8);
  EXPECT_DOUBLE_EQ(summarise(frames).length_d->most, 0.2);
  for (FrameIndex i = 2; i < 5; ++i) frames.push_back({i, {}, 40.0});
  EXPECT_FALSE(summarise(frames).length_px);
  EXPECT_EQ(summarise(frames).declined, 3u);
}

}  // namespace
}  // namespace relock
