#include "cli/gains.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "made_comparison.h"

namespace relock {
namespace {

/// What each method said of the one target, one letter a frame (made_comparison.h).
StoredComparison comparison(const std::string& gaps,
                            const std::vector<std::pair<std::string, std::string>>& said) {
  std::vector<MadeRun> runs;
  for (const auto& [method, letters] : said) runs.push_back({method, {letters}});
  return made_comparison("flight", runs, {.gaps = gaps});
}

const std::vector<StoredComparison> kcf_and_two_of_it{comparison("none", {{"kcf", "HHHHHHHH"},
                                                                          {"hybrid(ring,kcf)", "HHHHHHHH"},
                                                                          {"gap-aware(kcf)", "HHHHHHHH"},
                                                                          {"ring", "HHHHHHHH"}}),
                                                      comparison("paper", {{"kcf", "HHH..MMM"},
                                                                           {"hybrid(ring,kcf)", "HHH..HHH"},
                                                                           {"gap-aware(kcf)", "HHH..MHH"},
                                                                           {"ring", "HHH..HHH"}})};

TEST(Gains, AreARowForEachTrackerAndAColumnForEachCombination) {
  const auto all = gain_experiments(kcf_and_two_of_it, {});
  ASSERT_EQ(all.size(), 1u);
  ASSERT_EQ(all[0].rows.size(), 2u);
  const GainRow &kcf = all[0].rows[0], &ring = all[0].rows[1];
  EXPECT_EQ(kcf.tracker, "kcf");
  EXPECT_EQ(kcf.columns, (std::vector<std::string>{"alone", "gap-aware(T)", "hybrid(ring,T)"}));
  EXPECT_NEAR(kcf.gain.members[1].with[0].gain.value(), 2.0 / 6, 1e-12);
  EXPECT_NEAR(kcf.gain.members[2].with[0].gain.value(), 3.0 / 6, 1e-12);
  EXPECT_EQ(ring.columns, std::vector<std::string>{"alone"});
}

TEST(Gains, NeedTheTrackerAlone) {
  EXPECT_THROW(gain_experiments({comparison("none", {{"gap-aware(kcf)", "HHHH"}, {"csrt", "HHHH"}}),
                                 comparison("paper", {{"gap-aware(kcf)", "HH.H"}, {"csrt", "HH.H"}})},
                                {}),
               Error);
  auto more = kcf_and_two_of_it;
  for (StoredComparison& part : more) {
    part.runs.push_back(part.runs.back());
    part.runs.back().record.method = "guarded(csrt,ring)";
  }
  const auto all = gain_experiments(more, {});
  EXPECT_EQ(all[0].alone_is_missing, std::vector<std::string>{"guarded(csrt,ring)"});
  EXPECT_NE(gain_text(all[0], CostScore::locked_share).find("left out"), std::string::npos);
}

TEST(Gains, TellAsJsonWhatTheTableTells) {
  const std::string json = gain_json(gain_experiments(kcf_and_two_of_it, {}));
  for (const char* word :
       {"\"tracker\": \"kcf\"", "\"method\": \"hybrid(ring,kcf)\"", "\"locked_share\"", "\"gain\""})
    EXPECT_NE(json.find(word), std::string::npos) << word;
}

TEST(Gains, KnowScoresByTheirWords) {
  EXPECT_EQ(gain_score("losses"), CostScore::losses_per_minute);
  EXPECT_THROW(gain_score("lost"), Error);
}

}  // namespace
}  // namespace relock
