#include "eval/judgement/loss_changes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "eval/judgement/evaluation.h"
#include "made_flight.h"
#include "random_timelines.h"

namespace relock {
namespace {

/// Losses of what two methods say, one letter a frame at 30 Hz.
std::vector<LossChange> changes(const std::string& before, const std::string& after) {
  const Recording recording = made_flight(std::string(before.size(), 'v'));
  const auto losses = [&](const std::string& letters) {
    return evaluate(recording, said(recording, letters)).targets[0].losses;
  };
  return loss_changes(recording, losses(before), losses(after));
}

/// "kept moved(+2) gone new": later is in frames.
std::string fates(const std::string& before, const std::string& after) {
  std::string text;
  for (const LossChange& change : changes(before, after)) {
    text += (text.empty() ? "" : " ") + std::string(to_string(change.fate));
    const auto frames = std::lround(seconds(change.later) * 30);
    if (change.fate == LossFate::moved) text += (frames < 0 ? "(" : "(+") + std::to_string(frames) + ")";
  }
  return text;
}

TEST(LossChanges, OfTheSameRunAreNone) {
  EXPECT_EQ(fates("gHHHMMMMHHHHHMMMMHHHH", "gHHHMMMMHHHHHMMMMHHHH"), "kept kept");
  EXPECT_FALSE(changes("gHHHMMMMHHHHH", "gHHHMMMMHHHHH")[0].differs());
}

TEST(LossChanges, TellOnesThatOneRunAloneHas) {
  EXPECT_EQ(fates("gHHHHHHHHHHHH", "gHHHMMMMHHHHH"), "new");
  EXPECT_EQ(fates("gHHHMMMMHHHHH", "gHHHHHHHHHHHH"), "gone");
  EXPECT_EQ(fates("gHHHHHHHHHHHH", "gHHHHHHHHHHHH"), "");
}

TEST(LossChanges, TellAnEpisodeThatBeginsAtAnotherFrameAsMoved) {
  EXPECT_EQ(fates("gHHHMMMMMMMMHHHH", "gHHHHHMMMMMMHHHH"), "moved(+2)");
  EXPECT_EQ(fates("gHHHHHMMMMMMHHHH", "gHHHMMMMMMMMHHHH"), "moved(-2)");
  // Without a common moment, but for less than half a second.
  EXPECT_EQ(fates("gHHHMMMHHHHHHHHHHHHHHHH", "gHHHHHHHHHHMMMHHHHHHHHH"), "moved(+7)");
}

TEST(LossChanges, TellTwoEpisodesThatAreFarApartAsTwo) {
  const std::string held(20, 'H');
  EXPECT_EQ(fates("gHHHMMM" + held + "HHHHHH", "gHHHHHH" + held + "MMMHHH"), "gone new");
}

TEST(LossChanges, PairTheOnesWhoseOnsetsAreClosest) {
  // One long loss falls into two: the one that begins where it began is it.
  EXPECT_EQ(fates("gHHHMMMMMMMMMMMMMMMMHHHH", "gHHHMMMMHHHHHMMMMMMMHHHH"), "kept new");
  EXPECT_EQ(fates("gHHHMMMMHHHHHMMMMMMMHHHH", "gHHHMMMMMMMMMMMMMMMMHHHH"), "kept gone");
}

TEST(LossChanges, TellAKeptOneThatLastsLonger) {
  const auto all = changes("gHHHMMMMHHHHHHHH", "gHHHMMMMMMMHHHHH");
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].fate, LossFate::kept);
  EXPECT_TRUE(all[0].differs());
  EXPECT_NEAR(seconds(all[0].longer), 3.0 / 30, 1e-6);
}

TEST(LossChanges, TellAKeptOneThatIsNoLongerDeclared) {
  const auto all = changes("gHHHMMMMHHHHHHHH", "gHHHSSSSHHHHHHHH");
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].fate, LossFate::kept);
  EXPECT_TRUE(all[0].differs());
}

TEST(LossChanges, LeaveNoLossOutAndTurnRoundWithTheRuns) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const Case one = random_case(seed);
    Trajectory other = one.trajectory;  // silent on every third frame
    for (std::size_t frame = 0; frame < other.frames.size(); frame += 3)
      other.frames[frame].sightings.clear();
    const Evaluation a = evaluate(one.recording, one.trajectory), b = evaluate(one.recording, other);
    for (std::size_t t = 0; t < a.targets.size(); ++t) {
      const auto &before = a.targets[t].losses, &after = b.targets[t].losses;
      const auto there = loss_changes(one.recording, before, after),
                 back = loss_changes(one.recording, after, before);
      std::size_t befores = 0, afters = 0, paired = 0, paired_back = 0;
      for (const LossChange& change : there)
        befores += change.before.has_value(), afters += change.after.has_value(),
            paired += change.before && change.after;
      for (const LossChange& change : back) paired_back += change.before && change.after;
      EXPECT_EQ(befores, before.size()) << seed;
      EXPECT_EQ(afters, after.size()) << seed;
      EXPECT_EQ(paired, paired_back) << seed;
    }
  }
}

}  // namespace
}  // namespace relock
