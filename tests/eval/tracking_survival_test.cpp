#include "eval/scores/tracking_survival.h"

#include <gtest/gtest.h>

#include "tests/eval/random_timelines.h"

namespace relock {
namespace {

/// One target at 30 Hz, one letter a frame: g Given, H Hit, M Miss, . Dropped, r absent.
struct Told {
  Recording recording;
  Trajectory trajectory;
  TargetTimeline timeline;
};
Told told(const std::string& letters) {
  Told t;
  t.recording.period = std::chrono::milliseconds(33);
  LockWatch watch(t.recording.period);
  for (std::size_t i = 0; i < letters.size(); ++i) {
    Observation seen;
    seen.captured = Time{static_cast<std::int64_t>(i) * t.recording.period};
    seen.label = Label::visible;
    seen.verdict = Verdict::Miss;
    const char c = letters[i];
    if (c == 'g') seen.verdict = Verdict::Given;
    if (c == 'H') seen.verdict = Verdict::Hit, seen.hold = true;
    if (c == '.') seen.verdict = Verdict::Dropped;
    if (c == 'r') seen.verdict = Verdict::CorrectReject, seen.label = Label::absent;
    t.recording.captured.push_back(seen.captured);
    t.trajectory.frames.emplace_back().delivery = c == '.' ? Delivery::dropped : Delivery::delivered;
    Judgement judgement;
    judgement.verdict = seen.verdict;
    judgement.hold = seen.hold;
    t.timeline.judgements.push_back(judgement);
    watch.observe(seen);
  }
  auto story = watch.finish();
  t.timeline.states = std::move(story.states);
  t.timeline.losses = std::move(story.losses);
  return t;
}

std::vector<TrackingLifetime> lifetimes(const std::string& letters) {
  const Told t = told(letters);
  return tracking_lifetimes(t.recording, t.trajectory, t.timeline);
}

TEST(TrackingLifetime, LastsFromTheGivenToTheLastHoldBeforeTheLoss) {
  const auto found = lifetimes("gHHHMMMMHHHHMMMM");
  ASSERT_EQ(found.size(), 1u) << "the lock that the method found by itself is nobody's gift";
  EXPECT_EQ(found[0].frames, 3u);
  EXPECT_DOUBLE_EQ(found[0].seconds, 0.099);
  EXPECT_TRUE(found[0].lost);
}

TEST(TrackingLifetime, CountsDeliveredFramesButAllOfTheTime) {
  const auto found = lifetimes("gH..HMMMM");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].frames, 2u);
  EXPECT_DOUBLE_EQ(found[0].seconds, 4 * 0.033);
}

TEST(TrackingLifetime, IsCensoredAtTheLastHoldWhenTheRecordingEndsOrTheTargetLeaves) {
  for (const char* letters : {"gHHHMM", "gHHHMMrrrr", "gHHHMMrrrHHHHHMMMMM"}) {
    const auto found = lifetimes(letters);
    ASSERT_EQ(found.size(), 1u) << letters;
    EXPECT_EQ(found[0].frames, 3u) << letters;
    EXPECT_FALSE(found[0].lost) << letters;
  }
}

TEST(TrackingLifetime, IsNoneWhenNothingWasHeldAfterTheStart) {
  const auto found = lifetimes("gMMMMMgHHMMMM");
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].frames, 0u);
  EXPECT_TRUE(found[0].lost);
  EXPECT_EQ(found[1].frames, 2u);
  EXPECT_TRUE(found[1].lost);
}

TEST(TrackingLifetime, IsOfEveryGivenAndEveryLossBelongsToOneAtMost) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Case drawn = random_case(seed);
    const Evaluation evaluation = evaluate(drawn.recording, drawn.trajectory);
    for (const TargetTimeline& timeline : evaluation.targets) {
      const auto found = tracking_lifetimes(drawn.recording, drawn.trajectory, timeline);
      std::size_t given = 0, lost = 0;
      for (const Judgement& judged : timeline.judgements) given += judged.verdict == Verdict::Given ? 1 : 0;
      for (const TrackingLifetime& one : found) lost += one.lost ? 1 : 0;
      EXPECT_EQ(found.size(), given) << seed;
      EXPECT_LE(lost, timeline.losses.size()) << seed;
    }
  }
}

TrackingSurvivals of_locks(std::size_t frames, double rate_hz) {
  std::vector<TrackingLifetime> all;
  for (std::size_t i = 0; i < 20; ++i)
    all.push_back({frames + i, static_cast<double>(frames + i) / rate_hz, true});
  return tracking_survival(all);
}

TEST(TrackingSurvival, HoldsTheClaimAgainstBothMedians) {
  EXPECT_EQ(judge_claim(of_locks(90, 30)), ClaimVerdict::agrees);
  EXPECT_EQ(judge_claim(of_locks(90, 5)), ClaimVerdict::slower);
  EXPECT_EQ(judge_claim(of_locks(10, 30)), ClaimVerdict::sooner);
  EXPECT_EQ(judge_claim(of_locks(300, 30)), ClaimVerdict::longer);
  EXPECT_EQ(judge_claim(tracking_survival({})), ClaimVerdict::too_few);
  EXPECT_EQ(judge_claim(tracking_survival({{0, 0, true}, {3, 0.1, true}, {50, 2, false}, {60, 2, false}})),
            ClaimVerdict::too_few)
      << "nobody knows how long the others would have held";
}

TEST(TrackingSurvival, AtATimeMeansAHoldThenOrLater) {
  const auto found = tracking_survival({{100, 6, true}, {99, 5.9, true}, {200, 12, false}, {50, 3, true}});
  EXPECT_DOUBLE_EQ(found.frames.at_claim.value(), 0.5);
  EXPECT_DOUBLE_EQ(found.seconds.at_claim.value(), 0.5);
  EXPECT_EQ(found.losses, 3u);
}

TEST(TrackingSurvival, IsUnknownBeyondTheFollowUp) {
  const auto found = tracking_survival({{80, 4, false}, {50, 3, true}});
  EXPECT_EQ(found.frames.at_claim, std::nullopt);
}

}  // namespace
}  // namespace relock
