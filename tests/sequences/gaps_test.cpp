#include "sequences/gaps.h"

#include <gtest/gtest.h>

#include <map>

#include "source_folder.h"
#include "tests/sequences/scratch.h"

namespace relock {
namespace {

constexpr Duration kPeriod = std::chrono::milliseconds(33);
constexpr std::size_t kFrames = 40000;

std::vector<Time> steady(std::size_t frames) {
  std::vector<Time> all;
  for (std::size_t i = 0; i < frames; ++i) all.push_back(Time{static_cast<std::int64_t>(i) * kPeriod});
  return all;
}

Schedule applied(const std::string& pattern, std::uint64_t seed = 1, std::size_t frames = kFrames) {
  return GapPattern::parse(pattern).apply(steady(frames), kPeriod, seed, {});
}

/// Share of delivered intervals of each length in slots.
std::map<std::size_t, double> interval_shares(const Schedule& schedule) {
  std::map<std::size_t, double> count;
  double all = 0;
  std::size_t last = 0;
  for (std::size_t i = 1; i < schedule.frames(); ++i) {
    if (!schedule.delivered(i)) continue;
    ++count[i - last];
    ++all;
    last = i;
  }
  for (auto& [slots, share] : count) share /= all;
  return count;
}

double mean_interval(const Schedule& schedule) {
  double mean = 0;
  for (const auto& [slots, share] : interval_shares(schedule)) mean += static_cast<double>(slots) * share;
  return mean;
}

TEST(Gaps, OfThePaperAreOneIntervalInTwentyOfFourSlots) {
  auto shares = interval_shares(applied("paper"));
  EXPECT_NEAR(shares[4], 0.05, 0.005);
  EXPECT_NEAR(shares[1], 0.95, 0.005);
}

TEST(Gaps, OfThePaperInSixSecondsLetAHundredFramesPass) {
  const Schedule schedule = applied("paper-6s");
  EXPECT_NEAR(mean_interval(schedule), 1.8, 0.02);
  EXPECT_NEAR(interval_shares(schedule)[4], 0.05, 0.006);
}

TEST(Gaps, OfAStatedLengthHaveItAndTheirShareOfIntervals) {
  auto shares = interval_shares(applied("gaps(7,0.1)"));
  EXPECT_NEAR(shares[7], 0.1, 0.008);
  EXPECT_NEAR(shares[1], 0.9, 0.008);
  EXPECT_EQ(shares.size(), 2u);
}

TEST(Gaps, OfOneSlotTakeNothing) {
  const auto shares = interval_shares(applied("gaps(1,0.5)"));
  EXPECT_EQ(shares.size(), 1u);
  EXPECT_EQ(shares.at(1), 1);
}

TEST(Gaps, OfThePaperAreOneInTwentyOfFourSlotsByTheGeneralPatternToo) {
  const Schedule named = applied("paper", 3, 2000), stated = applied("gaps(4,0.05)", 3, 2000);
  for (std::size_t i = 0; i < 2000; ++i) EXPECT_EQ(named.delivered(i), stated.delivered(i));
}

TEST(Gaps, OfBernoulliTakeEachSlotAlike) {
  EXPECT_NEAR(mean_interval(applied("bernoulli(0.25)")), 1 / 0.75, 0.02);
}

TEST(Gaps, OfGilbertAndElliottComeInBursts) {
  // A burst begins with 0.1 and goes on with 0.75: 4 slots long on average, 0.1 / (0.1 + 0.25) of all slots.
  const Schedule schedule = applied("gilbert-elliott(0.1,0.25)");
  double lost = 0, bursts = 0;
  for (std::size_t i = 1; i < schedule.frames(); ++i) {
    if (schedule.delivered(i)) continue;
    ++lost;
    bursts += schedule.delivered(i - 1) ? 1 : 0;
  }
  EXPECT_NEAR(lost / kFrames, 0.1 / 0.35, 0.01);
  EXPECT_NEAR(lost / bursts, 4, 0.2);
}

TEST(Gaps, ThatArePeriodicTakeTheLastOfEveryN) {
  const Schedule schedule = applied("periodic(5,2)", 1, 11);
  std::string letters;
  for (std::size_t i = 0; i < 11; ++i) letters += schedule.delivered(i) ? 'd' : '.';
  EXPECT_EQ(letters, "ddd..ddd..d");
}

TEST(Gaps, AtALowerRateLeaveThatRate) {
  const auto shares = interval_shares(applied("fps(10)"));
  EXPECT_NEAR(mean_interval(applied("fps(10)")), 100.0 / 33, 0.01);
  EXPECT_EQ(shares.size(), 2u);
}

TEST(Gaps, OfARealCameraHaveItsShareOfIntervals) {
  const std::string trace = "trace(" RELOCK_SOURCE_DIR "/recordings/gap_traces/tagslam_test_14_top_left.csv)";
  const auto schedule = applied(trace);
  double long_gaps = 0;
  for (const auto& [slots, share] : interval_shares(schedule)) long_gaps += slots >= 3 ? share : 0;
  EXPECT_NEAR(long_gaps, 0.084, 0.003);  // 84 in 1000 of the trace's own
}

TEST(Gaps, AreTheSameForTheSameSeedAndOthersForAnother) {
  const auto bits = [](const Schedule& s) {
    std::string all;
    for (std::size_t i = 0; i < s.frames(); ++i) all += s.delivered(i) ? '1' : '0';
    return all;
  };
  for (const char* pattern : {"paper", "paper-6s", "bernoulli(0.3)", "gilbert-elliott(0.1,0.5)"}) {
    EXPECT_EQ(bits(applied(pattern, 4, 500)), bits(applied(pattern, 4, 500)));
    EXPECT_NE(bits(applied(pattern, 4, 500)), bits(applied(pattern, 5, 500)));
  }
}

TEST(Gaps, CountTheSlotsThatWereNotRecorded) {
  // Recorded slots 0, 1, 5, 6, 7: of every 4 slots the last is lost, and slot 3 was not recorded.
  std::vector<Time> captured;
  for (const std::int64_t slot : {0, 1, 5, 6, 7}) captured.push_back(Time{slot * kPeriod});
  const Schedule schedule = GapPattern::parse("periodic(4,1)").apply(captured, kPeriod, 1, {});
  EXPECT_TRUE(schedule.delivered(1) && schedule.delivered(2) && schedule.delivered(3));
  EXPECT_FALSE(schedule.delivered(4));
}

TEST(Gaps, LeaveStartFramesAlone) {
  const std::vector<FrameIndex> kept{3, 17};
  const Schedule schedule = GapPattern::parse("bernoulli(1)").apply(steady(30), kPeriod, 1, kept);
  for (std::size_t i = 1; i < 30; ++i) EXPECT_EQ(schedule.delivered(i), i == 3 || i == 17);
}

TEST(Gaps, ThatAreNotKnownShowThoseThatAre) {
  EXPECT_NE(fault_of([] { GapPattern::parse("papre"); }).find("is not known; patterns are none, paper"),
            std::string::npos);
  EXPECT_NE(fault_of([] { GapPattern::parse("gaps(2.5,0.1)"); }).find("needs a whole number of slots"),
            std::string::npos);
  EXPECT_NE(fault_of([] { GapPattern::parse("bernoulli(2)"); }).find("a number from 0 to 1"),
            std::string::npos);
  EXPECT_NE(fault_of([] { GapPattern::parse("trace(/nowhere.csv)"); }).find("cannot be read"),
            std::string::npos);
}

}  // namespace
}  // namespace relock
