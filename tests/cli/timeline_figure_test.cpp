#include "cli/timeline_figure.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "cli/chosen_methods.h"
#include "core/error.h"
#include "made_comparison.h"

namespace relock {
namespace {

constexpr double kFrame_s = 1. / 30;

/// Of all runs and targets of made runs (made_comparison.h).
LanePlot figure(StoredComparison made) {
  std::vector<std::size_t> runs, targets;
  for (std::size_t i = 0; i < made.runs.size(); ++i) runs.push_back(i);
  for (std::size_t t = 0; t < made.recording.targets.size(); ++t) targets.push_back(t);
  return timeline_figure(scored(std::move(made), Gate{}), runs, targets);
}

/// Of one lane: "Hit 0-3 Miss 3-5", in frames.
std::string told(const LanePlot& plot, std::size_t lane) {
  std::string text;
  std::size_t last = plot.kinds.size();
  double to = -1;
  for (const LaneStretch& stretch : plot.lanes.at(lane).stretches) {
    const auto frames = [](double s) { return std::lround(s / kFrame_s); };
    if (stretch.kind == last && std::abs(stretch.from - to) < 1e-9)
      text.erase(text.rfind('-'));
    else
      text += fmt::format("{}{} {}", text.empty() ? "" : " ", plot.kinds[stretch.kind], frames(stretch.from));
    text += fmt::format("-{}", frames(stretch.to));
    last = stretch.kind, to = stretch.to;
  }
  return text;
}

TEST(TimelineFigure, ShowsEveryVerdictForAsLongAsItsFrame) {
  const LanePlot plot = figure(made_comparison("a", {{"kcf", {"HHHSSMMH"}}}));
  ASSERT_EQ(plot.lanes.size(), 1u);
  EXPECT_EQ(plot.lanes[0].name, "kcf");
  EXPECT_EQ(told(plot, 0), "Hit 0-3 Stray 3-5 Miss 5-7 Hit 7-8");
}

TEST(TimelineFigure, NamesTheKindsThatOccurAndNoOthers) {
  EXPECT_EQ(figure(made_comparison("a", {{"kcf", {"HHHSSH"}}})).kinds,
            (std::vector<std::string>{"Hit", "Stray"}));
  EXPECT_EQ(figure(made_comparison("a", {{"kcf", {"HHHHHH"}}})).kinds, std::vector<std::string>{"Hit"});
}

TEST(TimelineFigure, ShowsFramesThatNeverCameOverTheLanesAndAsABreakInEach) {
  const LanePlot plot = figure(made_comparison("a", {{"kcf", {"HH..HH"}}, {"csrt", {"HH..MM"}}}));
  ASSERT_EQ(plot.lanes.size(), 3u);
  EXPECT_EQ(plot.lanes[0].name, "gaps");
  EXPECT_EQ(told(plot, 0), "dropped 2-4");
  EXPECT_EQ(told(plot, 1), "Hit 0-2 Hit 4-6");
  EXPECT_EQ(told(plot, 2), "Hit 0-2 Miss 4-6");
}

TEST(TimelineFigure, ShowsFramesThatWereNeverRecorded) {
  StoredComparison made = made_comparison("a", {{"kcf", {"HHHHHH"}}});
  for (std::size_t frame = 3; frame < 6; ++frame) made.recording.captured[frame] += 4 * made.recording.period;
  const LanePlot plot = figure(std::move(made));
  ASSERT_EQ(plot.lanes.size(), 2u);
  EXPECT_EQ(told(plot, 0), "not recorded 3-7");
  EXPECT_EQ(told(plot, 1), "Hit 0-3 Hit 7-10");
}

TEST(TimelineFigure, ShowsTheTrueBlurWhereItIsKnown) {
  LanePlot plot = figure(made_comparison("a", {{"kcf", {"HHHH"}}}));
  ASSERT_EQ(plot.above.size(), 4u);  // made blur grows by 1 px a frame
  EXPECT_EQ(plot.above[3].value, 3);
  StoredComparison sharp = made_comparison("a", {{"kcf", {"HHHH"}}});
  for (TargetTruth& truth : sharp.recording.truth) truth.blur.reset();
  EXPECT_TRUE(figure(std::move(sharp)).above.empty());
}

TEST(TimelineFigure, NamesTheTargetsWhereThereAreSeveral) {
  const LanePlot plot = figure(made_comparison("a", {{"kcf", {"HHH", "MMM"}}}));
  ASSERT_EQ(plot.lanes.size(), 2u);
  EXPECT_EQ(plot.lanes[0].name, "target 0: kcf");
  EXPECT_EQ(plot.lanes[1].name, "target 1: kcf");
}

TEST(ChosenRuns, AreThoseThatAreNamedElseAllWithYardsticksWhereWanted) {
  const StoredComparison made =
      made_comparison("a", {{"kcf", {"H"}}, {"csrt", {"H"}}, {"still", {"H"}, true}});
  using Places = std::vector<std::size_t>;
  EXPECT_EQ(chosen_runs(made, {}, Yardsticks::too), (Places{0, 1, 2}));
  EXPECT_EQ(chosen_runs(made, {}, Yardsticks::if_alone), (Places{0, 1}));
  EXPECT_EQ(chosen_runs(made, {"still", "kcf"}, Yardsticks::if_alone), (Places{2, 0}));
  EXPECT_EQ(chosen_runs(made_comparison("a", {{"still", {"H"}, true}}), {}, Yardsticks::if_alone),
            (Places{0}));
  EXPECT_THROW(check_methods({made}, {"crst"}), Error);
  EXPECT_NO_THROW(check_methods({made}, {"csrt", "still"}));
}

}  // namespace
}  // namespace relock
