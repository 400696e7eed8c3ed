#include "eval/scores/gain.h"

#include <gtest/gtest.h>

#include <deque>

namespace relock {
namespace {

constexpr std::size_t kTargets = 2;

/// Two targets that are always visible, at 30 Hz.
Recording recording_of(std::size_t frames, const std::string& name = "flight") {
  Recording made{name, {640, 360}, period_of(30), {}, {{"a"}, {"b"}}, {}};
  for (std::size_t i = 0; i < frames; ++i) {
    made.captured.push_back(Time{static_cast<std::int64_t>(i) * made.period});
    for (std::size_t t = 0; t < kTargets; ++t) {
      TargetTruth truth{Label::visible};
      truth.outline = Box{100 + 200.0 * static_cast<double>(t), 100, 40, 40};
      made.truth.push_back(truth);
    }
  }
  return made;
}

/// H where target a is, M nothing said, . never came, g given (again). Of b nothing is ever said.
Trajectory arm(const std::string& letters, bool asked_about_b = true) {
  Trajectory made;
  made.judged_from = {0, asked_about_b ? std::optional<FrameIndex>(0) : std::nullopt};
  made.failed_from.resize(kTargets);
  for (const char letter : letters) {
    FrameReport report;
    if (letter == '.') report.delivery = Delivery::dropped;
    if (letter == 'g') report.given = {0};
    if (letter == 'H') {
      report.sightings = {sighting_of(Box{100, 100, 40, 40})};
      report.sightings.front().track = "a";
    }
    made.frames.push_back(report);
  }
  return made;
}

double recognition(const MemberGain& member) { return member.with.front().value.value(); }

TEST(Gain, IsWhatTheSameFramesGiveMore) {
  const Recording recording = recording_of(12);
  const Trajectory easy = arm("gHHHHHHHHHHH", false), lost = arm("gHHH..MMMMMM", false),
                   held = arm("gHHH..MMHHHH", false);
  const std::vector<Family> families{{recording, {{recording, easy, lost}, {recording, easy, held}}}};
  const FamilyGain gain = gain_of(families);
  ASSERT_EQ(gain.members.size(), 2u);
  EXPECT_EQ(gain.common_frames, 10u);
  EXPECT_NEAR(recognition(gain.members[0]), 3.0 / 9, 1e-12);
  EXPECT_NEAR(recognition(gain.members[1]), 7.0 / 9, 1e-12);
  EXPECT_NEAR(gain.members[1].with.front().gain.value(), 4.0 / 9, 1e-12);
  EXPECT_EQ(gain.members[1].without.front().gain.value(), 0);
  EXPECT_FALSE(gain.members[0].with.front().gain);
  EXPECT_EQ(gain.members[0].losses_with, 1u);
  EXPECT_EQ(gain.members[1].losses_with, 0u);
}

TEST(Gain, IsOfTargetsThatAllMembersWereAskedAbout) {
  const Recording recording = recording_of(8);
  const Trajectory both = arm("HHHHHHHH"), one = arm("HHHHHHHH", false);
  const std::vector<Family> families{{recording, {{recording, both, both}, {recording, one, one}}}};
  const FamilyGain gain = gain_of(families);
  EXPECT_EQ(gain.targets, 2u);
  EXPECT_EQ(gain.common_targets, 1u);
  EXPECT_EQ(recognition(gain.members[0]), 1);  // b, of which it says nothing, does not count
  EXPECT_EQ(gain.members[1].with.front().gain.value(), 0);
}

TEST(Gain, IsUpToTheFirstResetOfAnyMember) {
  const Recording recording = recording_of(10);
  const Trajectory early = arm("gHMMMgHHHH", false), late = arm("gHHHHHMMMg", false);
  const std::vector<Family> families{{recording, {{recording, late, late}, {recording, early, early}}}};
  const FamilyGain gain = gain_of(families);
  EXPECT_EQ(gain.frames, 5u);
  EXPECT_EQ(recognition(gain.members[0]), 1);
  EXPECT_EQ(recognition(gain.members[1]), 0.25);
}

TEST(Gain, IsOfFramesThatCameInEveryArm) {
  const Recording recording = recording_of(10);
  const Trajectory whole = arm("HHHHHHHHHH"), slow = arm("H.H.H.H.H.");
  const std::vector<Family> families{{recording, {{recording, whole, whole}, {recording, slow, slow}}}};
  const FamilyGain gain = gain_of(families);
  EXPECT_EQ(gain.common_frames, 5u);
  EXPECT_EQ(gain.members[1].with.front().gain.value(), 0);
}

TEST(Gain, HasAnIntervalOverManySequencesThatKnowsWhichMemberIsBetter) {
  std::deque<Recording> recordings;
  std::deque<Trajectory> arms;
  std::vector<Family> families;
  const Trajectory easy = arm("HHHHHHHHHHHHHHHH");
  for (std::size_t i = 0; i < 12; ++i) {
    const std::size_t lost_from = 4 + i % 4;
    const Recording& recording = recordings.emplace_back(recording_of(16, "flight " + std::to_string(i)));
    const Trajectory& lost =
        arms.emplace_back(arm(std::string(lost_from, 'H') + std::string(16 - lost_from, 'M'), false));
    const Trajectory& held =
        arms.emplace_back(arm("HHHH" + std::string(i % 3, 'M') + std::string(12 - i % 3, 'H'), false));
    families.push_back({recording, {{recording, easy, lost}, {recording, easy, held}}});
  }
  const FamilyGain gain = gain_of(families);
  const Gained& gained = gain.members[1].with.front();
  ASSERT_TRUE(gained.interval);
  EXPECT_GT(gained.interval->low, 0);
  EXPECT_LT(gained.interval->low, *gained.gain);
  EXPECT_EQ(verdict_on(CostScore::recognition, gained.interval), 1);
  EXPECT_EQ(verdict_on(CostScore::losses_per_minute, gained.interval), -1);  // of losses less is better
}

}  // namespace
}  // namespace relock
