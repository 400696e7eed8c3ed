#include "eval/judgement/states.h"

#include <gtest/gtest.h>

namespace relock {
namespace {

constexpr Duration kPeriod = std::chrono::milliseconds(33);

/// Shows a LockWatch one frame a letter, at 30 Hz: g H W S M r . ? as in timelines, s a Stray that holds.
LockWatch::Story story(const std::string& letters) {
  LockWatch watch(kPeriod);
  for (std::size_t i = 0; i < letters.size(); ++i) {
    const char c = letters[i];
    Observation seen{
        Time{static_cast<std::int64_t>(i) * kPeriod}, Label::visible, Verdict::Miss, false, {}, {}, 40};
    switch (c) {
      case 'g':
        seen.verdict = Verdict::Given;
        break;
      case 'H':
        seen.verdict = Verdict::Hit, seen.hold = true;
        break;
      case 'W':
        seen.verdict = Verdict::WrongId;
        break;
      case 'S':
        seen.verdict = Verdict::Stray;
        break;
      case 's':
        seen.verdict = Verdict::Stray, seen.hold = true;
        break;
      case '.':
        seen.verdict = Verdict::Dropped;
        break;
      case 'r':
        seen.verdict = Verdict::CorrectReject, seen.label = Label::absent;
        break;
      case '?':
        seen.verdict = Verdict::Unlabelled, seen.label = Label::unlabelled;
        break;
      default:
        break;
    }
    watch.observe(seen);
  }
  return watch.finish();
}

std::string states(const std::string& letters) {
  std::string line;
  for (const State s : story(letters).states) line += " sLxo"[static_cast<std::size_t>(s)];
  return line;
}

TEST(Lock, BeginsAtTheFirstOfThreeHits) { EXPECT_EQ(states("MHMHHHH"), "sssLLLL"); }

TEST(Lock, IsHeldThroughTwoMissesAndLostFromTheLastHoldByThree) {
  EXPECT_EQ(states("gHHMMHH"), "LLLLLLL");
  EXPECT_EQ(states("gHHMMMHHH"), "LLxxxxLLL");
}

TEST(Lock, IsNotLostByTimeAlone) { EXPECT_EQ(states("gHH......MH"), "LLLLLLLLLLL"); }

TEST(Loss, EndsInARecoveryAtTheFirstHitOfTheNewLock) {
  const auto losses = story("gHHMMMHMHHH").losses;
  ASSERT_EQ(losses.size(), 1u);
  EXPECT_EQ(losses[0].last_good, 2);
  EXPECT_EQ(losses[0].first_lost, 3);
  EXPECT_EQ(losses[0].declared, 5);
  EXPECT_EQ(losses[0].end, LossEnd::recovered);
  EXPECT_EQ(losses[0].end_frame, 8) << "the isolated Hit before it is no recovery";
  EXPECT_EQ(losses[0].kind, LossKind::Declared);
}

TEST(Loss, IsSilentWhenStraysAreAsManyAsMisses) {
  EXPECT_EQ(story("gHHSSMM").losses.at(0).kind, LossKind::Silent);
  EXPECT_EQ(story("gHHSMMM").losses.at(0).kind, LossKind::Declared);
}

TEST(Loss, ByDriftNeedsASecondWithoutAHit) {
  EXPECT_TRUE(story("gHH" + std::string(30, 's')).losses.empty());
  const auto losses = story("gHH" + std::string(32, 's')).losses;
  ASSERT_EQ(losses.size(), 1u);
  EXPECT_EQ(losses[0].rule, LossRule::b);
  EXPECT_EQ(losses[0].kind, LossKind::Drift);
  EXPECT_EQ(losses[0].last_good, 2);
}

TEST(Loss, IsCensoredWhenTheTargetLeavesAndItsReturnIsASearch) {
  const auto told = story("gHHMMMMrrMHHH");
  ASSERT_EQ(told.losses.size(), 1u);
  EXPECT_EQ(told.losses[0].end, LossEnd::target_left);
  EXPECT_EQ(told.losses[0].end_frame, 6);
  ASSERT_EQ(told.acquisitions.size(), 1u);
  EXPECT_EQ(told.acquisitions[0], (Acquisition{Acquisition::Kind::reacquire, 9, 10}));
}

TEST(Loss, IsCensoredByAResetOnTheGivenFrame) {
  const auto losses = story("gHHMMMgHH").losses;
  ASSERT_EQ(losses.size(), 1u);
  EXPECT_EQ(losses[0].end, LossEnd::reset);
  EXPECT_EQ(losses[0].end_frame, 6);
}

TEST(Labels, ThatStopForMoreThanHalfASecondCensorALossAndEndRuns) {
  const auto told = story("gHHMMMM" + std::string(20, '?') + "HHH");
  EXPECT_EQ(told.losses.at(0).end, LossEnd::labels_stopped);
  EXPECT_EQ(told.acquisitions.at(0), (Acquisition{Acquisition::Kind::resume, 27, 27}));
  EXPECT_EQ(states("gHHMM" + std::string(5, '?') + "M").substr(2, 3), "xxx")
      << "a short stretch breaks no run";
}

TEST(ARelock, IsByChanceWhenTheTargetCameToAReportThatStoodStill) {
  LockWatch watch(kPeriod);
  std::int64_t frame = 0;
  const auto show = [&](Verdict verdict, double reported, double truth) {
    watch.observe({Time{frame++ * kPeriod},
                   Label::visible,
                   verdict,
                   verdict == Verdict::Hit,
                   {reported, 0},
                   {truth, 0},
                   40});
  };
  show(Verdict::Given, 0, 0);
  for (int i = 0; i < 5; ++i) show(Verdict::Stray, 100, 0);
  for (int i = 0; i < 3; ++i) show(Verdict::Hit, 100, 98);
  const auto story = watch.finish();
  EXPECT_EQ(story.losses.at(0).end, LossEnd::chance);
  EXPECT_EQ(story.states.back(), State::Locked);
}

}  // namespace
}  // namespace relock
