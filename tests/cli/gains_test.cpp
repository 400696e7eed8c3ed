#include "cli/gains.h"

#include <gtest/gtest.h>

#include "cli/combinations.h"
#include "core/error.h"

namespace relock {
namespace {

/// Runs of methods on a target that is always visible: H where it is, M nothing said, . never came.
StoredComparison comparison(const std::string& gaps,
                            const std::vector<std::pair<std::string, std::string>>& runs) {
  const std::size_t frames = runs.front().second.size();
  StoredComparison made{{}, {"flight", {640, 360}, period_of(30), {}, {{"target"}}, {}}, {}};
  for (std::size_t i = 0; i < frames; ++i) {
    made.recording.captured.push_back(Time{static_cast<std::int64_t>(i) * made.recording.period});
    TargetTruth truth{Label::visible};
    truth.outline = Box{100, 100, 40, 40};
    made.recording.truth.push_back(truth);
  }
  for (const auto& [method, letters] : runs) {
    StoredRun run;
    run.record.recording = "flight";
    run.record.method = method;
    run.record.gaps = gaps;
    run.trajectory.judged_from = {0};
    run.trajectory.failed_from = {{}};
    for (const char letter : letters) {
      FrameReport report;
      if (letter == '.') report.delivery = Delivery::dropped;
      if (letter == 'H') report.sightings = {sighting_of(Box{100, 100, 40, 40})};
      run.trajectory.frames.push_back(report);
    }
    made.runs.push_back(run);
  }
  return made;
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

TEST(Combinations, KnowTheTrackerInThem) {
  const auto tracker = [](const std::string& text) -> std::string {
    const auto found = tracker_in(parse_methods(text).front());
    return found ? found->text() : "none";
  };
  EXPECT_EQ(tracker("guarded(gap-aware(kcf(resize=false),margin=0.2),ring)"), "kcf(resize=false)");
  EXPECT_EQ(tracker("hybrid(ring,blur-predict(blut,ring))"), "blut");
  EXPECT_EQ(tracker("track(csrt)"), "csrt");
  EXPECT_EQ(tracker("detect(ring)"), "none");
  EXPECT_EQ(with_tracker(parse_methods("guarded(gap-aware(kcf,margin=0.2),ring)").front(), "T").text(),
            "guarded(gap-aware(T,margin=0.2),ring)");
}

}  // namespace
}  // namespace relock
