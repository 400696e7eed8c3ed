#include "cli/scores/judged.h"

#include <gtest/gtest.h>

#include "made_comparison.h"

namespace relock {
namespace {

constexpr std::size_t kFrames = 600, kRecognition = 0;

/// By name, of the only table.
std::map<std::string, JudgedMethod> judged_by_name(const std::vector<StoredComparison>& all) {
  const auto tables = judged_tables(all);
  std::map<std::string, JudgedMethod> methods;
  for (std::size_t i = 0; i < tables.at(0).methods.size(); ++i)
    methods[tables[0].table.methods[i].method] = tables[0].methods[i];
  return methods;
}

TEST(Standings, AreWorseForAMethodThatIsClearlyWorse) {
  const auto methods = judged_by_name({made_comparison(
      "a", {{"good", {with_outages(kFrames, 50, 2)}}, {"bad", {with_outages(kFrames, 20, 9)}}})});
  EXPECT_EQ(methods.at("good").standings[kRecognition], Standing::best);
  EXPECT_EQ(methods.at("bad").standings[kRecognition], Standing::worse);
}

TEST(Standings, AreTiedForAMethodThatMissesAsMuchElsewhere) {
  const auto methods = judged_by_name({made_comparison(
      "a", {{"one", {with_outages(kFrames, 40, 6)}}, {"other", {with_outages(kFrames, 41, 6, 22)}}})});
  EXPECT_EQ(methods.at("other").standings[kRecognition] == Standing::best
                ? methods.at("one").standings[kRecognition]
                : methods.at("other").standings[kRecognition],
            Standing::tied);
}

TEST(Standings, AreTiedForAMethodThatSaysTheSame) {
  const std::string said = with_outages(kFrames, 40, 6);
  const auto methods = judged_by_name({made_comparison("a", {{"one", {said}}, {"twin", {said}}})});
  EXPECT_EQ(methods.at("one").standings[kRecognition], Standing::best);
  EXPECT_EQ(methods.at("twin").standings[kRecognition], Standing::tied);
}

TEST(Standings, LeaveYardsticksOut) {
  const auto methods = judged_by_name({made_comparison("a", {{"mine", {with_outages(kFrames, 40, 6)}},
                                                             {"oracle", {std::string(kFrames, 'H')}, true},
                                                             {"mute", {std::string(kFrames, 'M')}, true}})});
  for (std::size_t score = 0; score < kShareScores; ++score) {
    EXPECT_EQ(methods.at("mine").standings[score], Standing::best) << share_scores()[score].name;
    EXPECT_EQ(methods.at("oracle").standings[score], Standing::none) << share_scores()[score].name;
    EXPECT_EQ(methods.at("mute").standings[score], Standing::none) << share_scores()[score].name;
  }
}

TEST(Standings, AreUntoldByOneRecordingWithoutOutagesAndWorseWhenEachOfTwelveSaysSo) {
  const std::string always(kFrames, 'H'), never(kFrames, 'M');
  std::vector<StoredComparison> all{made_comparison("0", {{"always", {always}}, {"never", {never}}})};
  EXPECT_EQ(judged_by_name(all).at("never").standings[kRecognition], Standing::untold);
  for (int i = 1; i < 12; ++i)
    all.push_back(made_comparison(std::to_string(i), {{"always", {always}}, {"never", {never}}}));
  EXPECT_EQ(judged_by_name(all).at("always").standings[kRecognition], Standing::best);
  EXPECT_EQ(judged_by_name(all).at("never").standings[kRecognition], Standing::worse);
}

TEST(Standings, CallNobodyWorseWhoIsBetterWhereverBothWere) {
  std::vector<StoredComparison> all;
  for (std::size_t i = 0; i < 10; ++i)
    all.push_back(made_comparison(std::to_string(i), {{"elsewhere", {with_outages(kFrames, 40 + i, 4)}},
                                                      {"everywhere", {with_outages(kFrames, 60 + i, 2)}}}));
  all.push_back(made_comparison("hard", {{"everywhere", {std::string(kFrames, 'M')}}}));
  const auto methods = judged_by_name(all);
  ASSERT_EQ(methods.at("elsewhere").standings[kRecognition], Standing::best);
  EXPECT_EQ(methods.at("everywhere").standings[kRecognition], Standing::untold);
}

TEST(Standings, RestOnRecordingsThatBothHave) {
  const std::string one = with_outages(kFrames, 40, 6), other = with_outages(kFrames, 41, 6, 22),
                    poor = with_outages(kFrames, 15, 11);
  const auto shared = made_comparison("shared", {{"one", {one}}, {"other", {other}}});
  const auto alone = judged_by_name({shared, made_comparison("hard", {{"other", {poor}}})});
  EXPECT_EQ(alone.at("one").standings[kRecognition], Standing::best);
  EXPECT_LT(*alone.at("other").scores.recognition, *alone.at("one").scores.recognition - 0.2);
  EXPECT_EQ(alone.at("other").standings[kRecognition], Standing::tied);
  const auto both = judged_by_name({shared, made_comparison("hard", {{"one", {one}}, {"other", {poor}}})});
  EXPECT_EQ(both.at("other").standings[kRecognition], Standing::worse);
}

TEST(Intervals, HoldTheirScore) {
  const auto methods = judged_by_name({made_comparison("a", {{"mine", {with_outages(kFrames, 30, 8)}}})});
  const JudgedMethod& mine = methods.at("mine");
  for (std::size_t score = 0; score < kShareScores; ++score) {
    const auto& interval = mine.shares[score];
    if (!interval) continue;
    const double value = *(mine.scores.*share_scores()[score].value);
    EXPECT_LE(interval->low, value) << share_scores()[score].name;
    EXPECT_GE(interval->high, value) << share_scores()[score].name;
  }
  EXPECT_TRUE(mine.shares[kRecognition]);
  ASSERT_TRUE(mine.losses_per_minute);
  EXPECT_LT(mine.losses_per_minute->low, *mine.scores.losses_per_minute);
  EXPECT_GT(mine.losses_per_minute->high, *mine.scores.losses_per_minute);
}

TEST(ShareScores, AreWhatTheirFramesAddUpTo) {
  const auto table =
      pooled_tables(
          {made_comparison(
              "a", {{"mine", {"HHHHHMHHHHHHMMMMMMHHHHHSSSHHHHHH", "HHHHSHHHHHHHMMMMMMHHHHHSSSHHHHHH"}}})})
          .at(0);
  const JudgedMethod mine = judged(table).at(0);
  for (const ShareScore& score : share_scores()) {
    double part = 0, whole = 0;
    for (const Contribution& frame : table.methods[0].frames.at("a"))
      part += score.part(frame), whole += score.whole(frame);
    EXPECT_NEAR(part / whole, *(mine.scores.*score.value), 1e-12) << score.name;
  }
}

TEST(CommonHits, AreThoseOfAllMethodsButYardsticks) {
  const auto methods = judged_by_name({made_comparison(
      "a", {{"one", {"HHHHHHMMMHHH"}}, {"other", {"HHHMMHHHHHHH"}}, {"mute", {"MMMMMMMMMMMM"}, true}})});
  EXPECT_EQ(methods.at("one").common.hits, 7u);
  EXPECT_EQ(methods.at("other").common.hits, 7u);
  EXPECT_EQ(methods.at("mute").common.hits, 0u);
}

}  // namespace
}  // namespace relock
