#include "cli/scores/pool.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/error.h"
#include "eval/replay/multistart.h"
#include "eval/scores/scores.h"
#include "made_comparison.h"

namespace relock {
namespace {

const std::string kFirst = "HHHHHMHHHHHHMMMMMMHHHHHSSSHHHHHH", kSecond = "HHHHMMMMMMMMHHHHHHMH";

void expect_same(const Scores& a, const Scores& b) {
  EXPECT_EQ(a.frames, b.frames);
  EXPECT_EQ(a.verdicts, b.verdicts);
  EXPECT_EQ(a.recognition, b.recognition);
  EXPECT_EQ(a.precision, b.precision);
  EXPECT_EQ(a.availability, b.availability);
  EXPECT_EQ(a.availability_of_ceiling, b.availability_of_ceiling);
  EXPECT_EQ(a.locked_share, b.locked_share);
  EXPECT_EQ(a.losses, b.losses);
  EXPECT_EQ(a.losses_per_minute, b.losses_per_minute);
  EXPECT_EQ(a.recovery.median_s, b.recovery.median_s);
  EXPECT_EQ(a.fix_age.p95_s, b.fix_age.p95_s);
  EXPECT_EQ(a.localization.p95_px, b.localization.p95_px);
  EXPECT_EQ(a.spurious_per_minute, b.spurious_per_minute);
}

TEST(PooledScores, AreThoseOfTalliesAddedUp) {
  const auto a = made_comparison("a", {{"mine", {kFirst}}}), b = made_comparison("b", {{"mine", {kSecond}}});
  Tally sum;
  for (const StoredComparison& one : {a, b}) {
    const ScoredComparison compared = scored(one, {});
    sum += compared.tallies[0][0].tally;
    sum += tally_of_frames(one.recording, compared.evaluations[0]);
  }
  const auto tables = pooled_tables({a, b});
  ASSERT_EQ(tables.size(), 1u);
  ASSERT_EQ(tables[0].methods.size(), 1u);
  EXPECT_GT(scores_of(sum).losses, 0u);
  expect_same(scores_of(tables[0].methods[0].tally), scores_of(sum));
}

TEST(PooledScores, OfTwoSeedsAddFrameByFrameAndAreOfOneRecording) {
  MadeConditions conditions{.gaps = "bernoulli(0.1)"};
  const auto one = made_comparison("a", {{"mine", {"HHHMMHHHHHHH"}}}, conditions);
  conditions.seed = 2;
  const auto two = made_comparison("a", {{"mine", {"HH.HMHHMMMHH"}}}, conditions);
  const auto tables = pooled_tables({one, two});
  ASSERT_EQ(tables.size(), 1u);
  EXPECT_EQ(tables[0].recordings, std::set<std::string>{"a"});
  EXPECT_EQ(tables[0].seeds, (std::set<std::uint64_t>{1, 2}));
  const MethodPool& pool = tables[0].methods.at(0);
  EXPECT_EQ(pool.runs, 2u);
  ASSERT_EQ(pool.frames.size(), 1u);
  const auto& frames = pool.frames.at("a");
  const auto first = scored(one, {}).tallies[0][0].frames, second = scored(two, {}).tallies[0][0].frames;
  ASSERT_EQ(frames.size(), first.size());
  for (std::size_t frame = 0; frame < frames.size(); ++frame) {
    Contribution both = first[frame];
    both += second[frame];
    EXPECT_EQ(frames[frame], both) << "frame " << frame;
  }
}

TEST(PooledScores, OfABackwardRunAreLaidBackToFront) {
  MadeConditions conditions{.protocol = Protocol::multistart, .anchor = Anchor{}};
  const auto forward = made_comparison("a", {{"mine", {kFirst}}}, conditions);
  conditions.anchor = Anchor{static_cast<FrameIndex>(kFirst.size()) - 1, Direction::backward};
  auto backward = made_comparison("a", {{"mine", {std::string(kFirst.rbegin(), kFirst.rend())}}}, conditions);
  backward.recording = reflected(forward.recording);
  const auto alone = pooled_tables({forward}), both = pooled_tables({forward, backward});
  ASSERT_EQ(both.size(), 1u);
  EXPECT_EQ(both[0].starts.size(), 2u);
  const auto& once = alone[0].methods[0].frames.at("a");
  const auto& twice = both[0].methods[0].frames.at("a");
  ASSERT_EQ(once.size(), twice.size());
  for (std::size_t frame = 0; frame < once.size(); ++frame) {
    EXPECT_EQ(twice[frame].could_hit, 2 * once[frame].could_hit) << "frame " << frame;
    EXPECT_EQ(twice[frame].hits, 2 * once[frame].hits) << "frame " << frame;
    EXPECT_EQ(twice[frame].said, 2 * once[frame].said) << "frame " << frame;
  }
}

TEST(PooledScores, OfABackwardRunThatWasCutShortBeginAtTheEndOfTheRecordingAllTheSame) {
  const MadeConditions conditions{.protocol = Protocol::multistart, .anchor = Anchor{9, Direction::backward}};
  auto cut = made_comparison("a", {{"mine", {"HHMH"}}}, conditions);
  cut.recorded_frames = 10;
  const auto frames = pooled_tables({cut})[0].methods[0].frames.at("a");
  std::string hits;
  for (const Contribution& frame : frames) hits += frame.hits > 0 ? 'H' : frame.could_hit > 0 ? 'M' : '.';
  EXPECT_EQ(hits, "......HMHH");
}

TEST(PooledScores, CountACopyOfARunOnce) {
  const auto once = made_comparison("a", {{"mine", {kFirst}}}, {.seed = 1}),
             again = made_comparison("a", {{"mine", {kFirst}}}, {.seed = 2});
  const auto alone = pooled_tables({once}), both = pooled_tables({once, again});
  EXPECT_EQ(both[0].methods[0].runs, 1u);
  EXPECT_EQ(both[0].methods[0].tally.frames, alone[0].methods[0].tally.frames);
}

TEST(KnownRecordings, RefuseAnotherOneOfTheSameName) {
  auto one = made_comparison("a", {{"mine", {kFirst}}}), other = one;
  other.runs[0].record.fingerprint = "another";
  KnownRecordings known;
  known.check(one);
  known.check(one);
  EXPECT_THROW(known.check(other), Error);
}

TEST(Tables, NeverHoldRunsOfOtherConditions) {
  std::vector<StoredComparison> all;
  for (const MadeConditions& conditions :
       std::vector<MadeConditions>{{},
                                   {.gaps = "paper"},
                                   {.protocol = Protocol::reset},
                                   {.real_time = "latest", .latency = "constant(20ms)"},
                                   {.real_time = "queue(2)", .latency = "constant(20ms)"},
                                   {.real_time = "latest", .latency = "constant(30ms)"}})
    all.push_back(made_comparison("a", {{"mine", {kFirst}}}, conditions));
  ScorePool pool(Grouping::none, 1);
  for (const StoredComparison& one : all) pool.add(scored(one, {}));
  pool.add(scored(all.front(), Gate::iou()));
  const auto tables = std::move(pool).tables();
  ASSERT_EQ(tables.size(), all.size() + 1);
  for (const ScoreTable& table : tables) EXPECT_EQ(table.methods.at(0).runs, 1u);
}

TEST(Tables, OfTheSameConditionsAreOneOverRecordings) {
  const auto tables = pooled_tables(
      {made_comparison("a", {{"mine", {kFirst}}}), made_comparison("b", {{"mine", {kSecond}}})});
  ASSERT_EQ(tables.size(), 1u);
  EXPECT_EQ(tables[0].recordings, (std::set<std::string>{"a", "b"}));
}

TEST(PooledFrames, AreTotalsFromTenRecordingsOn) {
  const auto of_recordings = [](std::size_t count) {
    std::vector<StoredComparison> all;
    for (std::size_t i = 0; i < count; ++i)
      all.push_back(made_comparison("recording " + std::to_string(i), {{"mine", {kFirst}}}));
    return pooled_tables(all).at(0).methods.at(0);
  };
  const MethodPool nine = of_recordings(9), ten = of_recordings(10);
  Contribution sum;
  for (const Contribution& frame : nine.frames.at("recording 3")) sum += frame;
  EXPECT_EQ(nine.frames.at("recording 3").size(), kFirst.size());
  ASSERT_EQ(ten.frames.size(), 10u);
  for (const auto& [recording, frames] : ten.frames) EXPECT_EQ(frames, std::vector{sum}) << recording;
}

TEST(Methods, AreByNameWithYardsticksLast) {
  const auto table = pooled_tables({made_comparison("a", {{"zebra", {kFirst}},
                                                          {"oracle", {kFirst}, true},
                                                          {"ant", {kFirst}},
                                                          {"mute", {kFirst}, true}})})
                         .at(0);
  std::vector<std::string> names;
  for (const MethodPool& method : table.methods) names.push_back(method.method);
  EXPECT_EQ(names, (std::vector<std::string>{"ant", "zebra", "mute", "oracle"}));
}

class GroupedTables : public testing::TestWithParam<Grouping> {};

TEST_P(GroupedTables, HaveHitsThatAddUpToThePooledOnes) {
  const std::string gappy = "HHH..HHMMHHHH....HHHHM.H";
  const std::vector<StoredComparison> all{
      made_comparison("a", {{"mine", {gappy, "HHHHHHHMMMHHHHHHHSSSHHHH"}}}),
      made_comparison("b", {{"mine", {kFirst, with_outages(kFirst.size(), 9, 2)}}})};
  const MethodPool pooled = pooled_tables(all).at(0).methods.at(0);
  Contribution sum;
  std::set<std::string> groups;
  for (const ScoreTable& table : pooled_tables(all, GetParam())) {
    groups.insert(table.group);
    EXPECT_EQ(table.grouping, GetParam());
    sum += table.methods.at(0).tally.sum;
  }
  EXPECT_GT(groups.size(), 1u);
  EXPECT_EQ(sum.hits, pooled.tally.sum.hits);
  EXPECT_EQ(sum.could_hit, pooled.tally.sum.could_hit);
}
INSTANTIATE_TEST_SUITE_P(By, GroupedTables,
                         testing::Values(Grouping::recording, Grouping::target, Grouping::code,
                                         Grouping::blur, Grouping::gap),
                         [](const auto& one) { return std::string(to_string(one.param)); });

TEST(Groupings, AreReadAsTheyAreWritten) {
  for (const Grouping grouping :
       {Grouping::recording, Grouping::target, Grouping::code, Grouping::blur, Grouping::gap})
    EXPECT_EQ(parse_grouping(to_string(grouping)), grouping);
  EXPECT_THROW(parse_grouping("colour"), Error);
  EXPECT_THROW(parse_grouping(""), Error);
}

}  // namespace
}  // namespace relock
