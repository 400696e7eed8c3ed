#include "cli/paired.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "made_comparison.h"

namespace relock {
namespace {

/// What one method said of the one target, one letter a frame (made_comparison.h).
StoredComparison comparison(const std::string& name, const std::string& gaps, std::uint64_t seed,
                            const std::string& letters, const std::string& method = "mine") {
  return made_comparison(name, {{method, {letters}}}, {.gaps = gaps, .seed = seed});
}

TEST(GapExperiments, AreOneForEachPatternOverRecordingsAndSeeds) {
  const auto all =
      gap_experiments({comparison("a", "none", 1, "HHHHHHHH"), comparison("a", "none", 2, "HHHHHHHH"),
                       comparison("b", "none", 1, "HHHHHHHH"), comparison("a", "paper", 1, "HH.HHHHH"),
                       comparison("a", "paper", 2, "HHH.HHHH"), comparison("b", "paper", 1, "H.HMHHHH"),
                       comparison("a", "fps(15)", 1, "H.H.H.H.")},
                      {});
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].gaps, "fps(15)");
  EXPECT_EQ(all[1].gaps, "paper");
  EXPECT_EQ(all[1].recordings, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(all[1].seeds, (std::vector<std::uint64_t>{1, 2}));
  const GapCost& cost = all[1].methods.at(0).cost;
  EXPECT_EQ(cost.pairs, 3u);
  EXPECT_EQ(cost.frames, 24u);
  EXPECT_EQ(cost.common_frames, 21u);
  EXPECT_NEAR(cost[CostScore::recognition].difference.value(), -1.0 / 21, 1e-12);
}

TEST(GapExperiments, ArePairedWithTheSameSeedOnly) {
  EXPECT_THROW(gap_experiments({comparison("a", "none", 1, "HHHH"), comparison("a", "paper", 2, "HH.H")}, {}),
               Error);
  const auto left_out =
      without_a_pair({comparison("a", "none", 1, "HHHH"), comparison("a", "paper", 1, "HH.H"),
                      comparison("a", "paper", 2, "HH.H")});
  ASSERT_EQ(left_out.size(), 1u);
  EXPECT_NE(left_out[0].find("seed 2"), std::string::npos) << left_out[0];
}

/// All of its runs were made in real time.
StoredComparison in_real_time(StoredComparison made, const std::string& latency) {
  for (StoredRun& run : made.runs) run.record.real_time = "latest", run.record.latency = latency;
  return made;
}

TEST(GapExperiments, ArePairedWithRunsInTheSameRealTimeOnly) {
  const auto recorded = comparison("a", "none", 1, "HHHH"), gaps = comparison("a", "paper", 1, "HH.H");
  const auto slow = in_real_time(gaps, "constant(70ms)");
  EXPECT_THROW(gap_experiments({recorded, slow}, {}), Error);
  EXPECT_THROW(gap_experiments({in_real_time(recorded, "constant(20ms)"), slow}, {}), Error);
  const auto left_out = without_a_pair({recorded, gaps, slow});
  ASSERT_EQ(left_out.size(), 1u);
  EXPECT_NE(left_out[0].find("real time latest, latency constant(70ms)"), std::string::npos) << left_out[0];
}

TEST(GapExperiments, InRealTimeAreExperimentsOfTheirOwn) {
  const auto recorded = comparison("a", "none", 1, "HHHH"), gaps = comparison("a", "paper", 1, "HH.H");
  const auto all = gap_experiments({recorded, gaps, in_real_time(recorded, "constant(70ms)"),
                                    in_real_time(comparison("a", "paper", 1, "HM.M"), "constant(70ms)")},
                                   {});
  ASSERT_EQ(all.size(), 2u);
  for (const GapExperiment& experiment : all) EXPECT_EQ(experiment.methods.at(0).cost.pairs, 1u);
  const std::string patient = cost_text(all[0]), hurried = cost_text(all[1]);
  EXPECT_EQ(patient.find("real time"), std::string::npos) << patient;
  EXPECT_NE(hurried.find("protocol once, real time latest, latency constant(70ms)"), std::string::npos)
      << hurried;
  EXPECT_EQ(all[1].methods[0].cost[CostScore::recognition].with, 1.0 / 3);
  EXPECT_NE(patient.find("3 of 4 recorded frames came in both arms"), std::string::npos) << patient;
  EXPECT_NE(hurried.find("3 of 4 recorded frames were looked at in both arms"), std::string::npos) << hurried;
}

TEST(GapExperiments, ArePairedFromTheSameAnchorOnly) {
  const auto from = [](FrameIndex frame, Direction direction, StoredComparison made) {
    for (StoredRun& run : made.runs)
      run.record.protocol = Protocol::multistart, run.record.anchor = Anchor{frame, direction};
    return made;
  };
  const auto recorded = comparison("a", "none", 1, "HHHH"), gaps = comparison("a", "paper", 1, "HH.H");
  const auto ahead = from(0, Direction::forward, recorded), back = from(0, Direction::backward, gaps);
  EXPECT_THROW(gap_experiments({ahead, back}, {}), Error);
  const auto all =
      gap_experiments({ahead, from(0, Direction::forward, gaps), from(50, Direction::forward, recorded),
                       from(50, Direction::forward, gaps)},
                      {});
  ASSERT_EQ(all.size(), 2u);
  EXPECT_NE(cost_text(all[1]).find("protocol multistart from frame 50 forward"), std::string::npos);
}

TEST(GapExperiments, LeaveOutAMethodThatOneArmDoesNotHave) {
  auto without = comparison("a", "none", 1, "HHHH"), with = comparison("a", "paper", 1, "HH.H");
  with.runs.push_back(comparison("a", "paper", 1, "HH.H", "other").runs.front());
  const auto all = gap_experiments({without, with}, {});
  ASSERT_EQ(all.at(0).methods.size(), 1u);
  EXPECT_EQ(all[0].methods[0].method, "mine");
}

/// As it is read from the results folder `out`.
StoredComparison found_in(const std::string& out, StoredComparison made) {
  made.folder = std::filesystem::path(out) / made.recording.name / made.runs.front().record.gaps;
  return made;
}

TEST(GapExperiments, FindTheArmOfEachMethodInItsOwnFolder) {
  const auto all = gap_experiments({found_in("P/a", comparison("a", "none", 1, "HHHH", "mine")),
                                    found_in("P/a", comparison("a", "paper", 1, "HH.H", "mine")),
                                    found_in("P/b", comparison("a", "none", 1, "HHHH", "other")),
                                    found_in("P/b", comparison("a", "paper", 1, "HH.M", "other"))},
                                   {});
  ASSERT_EQ(all.size(), 1u);
  ASSERT_EQ(all[0].methods.size(), 2u);
  EXPECT_EQ(all[0].methods[0].method, "mine");
  EXPECT_EQ(all[0].methods[1].method, "other");
  EXPECT_EQ(all[0].methods[1].cost[CostScore::recognition].with, 2.0 / 3);
}

TEST(GapExperiments, TakeTheArmOfTheSameFolderBeforeAnother) {
  const auto all = gap_experiments({found_in("P/a", comparison("a", "none", 1, "MMMM")),
                                    found_in("P/b", comparison("a", "none", 1, "HHHH")),
                                    found_in("P/b", comparison("a", "paper", 1, "HH.H"))},
                                   {});
  EXPECT_EQ(all.at(0).methods.at(0).cost[CostScore::recognition].without, 1.0);
}

TEST(GapExperiments, NameTheMethodsThatHaveNoArmAsRecorded) {
  auto without = comparison("a", "none", 1, "HHHH"), with = comparison("a", "paper", 1, "HH.H");
  with.runs.push_back(comparison("a", "paper", 1, "HH.H", "other").runs.front());
  const auto left_out = without_a_pair({without, with});
  ASSERT_EQ(left_out.size(), 1u);
  EXPECT_NE(left_out[0].find("no run of other as recorded"), std::string::npos) << left_out[0];
}

TEST(GapExperiments, CompareRunsThatWereCutShortAsFarAsBothGo) {
  const auto all =
      gap_experiments({comparison("a", "none", 1, "HHHHHHHH"), comparison("a", "paper", 1, "HH.HH")}, {});
  EXPECT_EQ(all.at(0).methods.at(0).cost.frames, 5u);
}

TEST(CostText, MarksWhatIsWorseAndSaysWhichYardsticksDoNotDiffer) {
  std::string without, with;
  for (int n = 0; n < 20; ++n) without += "HHHHHHHHHHHHHHHHHHHHHHHH", with += "HHHHHHHHHHHH...MMMMMHHHH";
  auto recorded = comparison("a", "none", 1, without), gaps = comparison("a", "paper", 1, with);
  for (auto* arm : {&recorded, &gaps}) {
    arm->runs.push_back(comparison("a", arm->runs[0].record.gaps, 1, without, "still").runs.front());
    arm->runs.back().record.yardstick = true;
  }
  for (std::size_t frame = 0; frame < with.size(); ++frame)
    if (with[frame] == '.') gaps.runs[1].trajectory.frames[frame] = {.delivery = Delivery::dropped};
  const std::string text = cost_text(gap_experiments({recorded, gaps}, {}).at(0));
  EXPECT_NE(text.find("420 of 480 recorded frames came in both arms"), std::string::npos) << text;
  EXPECT_NE(text.find("worse"), std::string::npos) << text;
  EXPECT_NE(text.find("yardsticks without any difference: still"), std::string::npos) << text;
  EXPECT_EQ(text.find("better"), std::string::npos) << text;
}

}  // namespace
}  // namespace relock
