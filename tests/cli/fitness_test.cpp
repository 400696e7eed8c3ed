#include <gtest/gtest.h>

#include <algorithm>

#include "cli/inspect/report.h"

namespace relock {
namespace {

/// A recording at 20 Hz with one target of 20 px that is visible on every frame.
InspectReport report_of(std::size_t frames) {
  InspectReport report;
  Recording& recording = report.sequence.recording;
  recording.picture = {640, 480};
  recording.period = std::chrono::milliseconds(50);
  recording.targets = {{"ball"}};
  for (std::size_t i = 0; i < frames; ++i) {
    recording.captured.push_back(Time{} + static_cast<std::int64_t>(i) * recording.period);
    TargetTruth& truth = recording.truth.emplace_back();
    truth.label = Label::visible;
    truth.outline = Box{100, 100, 20, 20};
  }
  return report;
}

std::string said(InspectReport report, Remark::Kind kind) {
  report.inspection = inspect(report.sequence.recording);
  std::string all;
  for (const Remark& remark : remarks(report))
    if (remark.kind == kind) all += remark.sentence + "\n";
  return all;
}
std::string limits(const InspectReport& report) { return said(report, Remark::Kind::limit); }
std::string fits(const InspectReport& report) { return said(report, Remark::Kind::fit); }

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Fitness, ToMeasureRecoveryComesWithFiveSeconds) {
  EXPECT_TRUE(has(limits(report_of(40)), "too short to measure every recovery: ball"));
  EXPECT_TRUE(has(fits(report_of(120)), "recovery within 5 s: ball"));
  EXPECT_FALSE(has(limits(report_of(120)), "too short"));
}

TEST(Fitness, ForGapsIsThatOfRecordedTimesOnly) {
  InspectReport report = report_of(40);
  EXPECT_TRUE(has(limits(report), "no gap of 3 slots or more"));
  for (std::size_t i = 20; i < 40; ++i)
    report.sequence.recording.captured[i] += std::chrono::milliseconds(150);
  EXPECT_TRUE(has(fits(report), "gaps as recorded: 1 of 39 intervals, up to 4 slots"));
  report.sequence.times_from = TimesFrom::assumed_rate;
  EXPECT_TRUE(has(limits(report), "times are from an assumed rate"));
  EXPECT_FALSE(has(fits(report), "gaps as recorded"));
}

TEST(Fitness, NamesLongStepsAndSmallTargets) {
  InspectReport report = report_of(10);
  report.sequence.recording.truth[7].outline = Box{118, 100, 20, 20};
  EXPECT_TRUE(has(limits(report), "ball steps up to 0.90 of its size between frames (frame 7)"));
  report.sequence.recording.truth[4].outline = Box{100, 100, 6, 6};
  EXPECT_TRUE(has(limits(report), "ball is as small as 6.0 px"));
}

TEST(Fitness, ForReacquiringNeedsATargetThatReturns) {
  InspectReport report = report_of(10);
  EXPECT_TRUE(has(limits(report), "never labelled absent"));
  report.sequence.recording.truth[4].label = Label::absent;
  EXPECT_TRUE(has(fits(report), "reacquiring after an absence: ball"));
  EXPECT_FALSE(has(limits(report), "never labelled absent"));
}

TEST(Fitness, OfSparseLabelsTellsTheShortestLossOrThatTheyStop) {
  InspectReport report = report_of(100);
  for (std::size_t i = 0; i < 100; ++i)
    if (i % 5 != 0) report.sequence.recording.truth[i].label = Label::unlabelled;
  EXPECT_TRUE(has(limits(report), "labelled on 20 % of the frames: losses shorter than about 0.75 s"));
  for (std::size_t i = 0; i < 100; ++i)
    if (i % 20 != 0) report.sequence.recording.truth[i].label = Label::unlabelled;
  EXPECT_TRUE(has(limits(report), "up to 1.0 s apart: beyond 0.5 s losses and recoveries are cut off"));
}

TEST(Fitness, ComesBeforeTheLimits) {
  InspectReport report = report_of(10);
  report.inspection = inspect(report.sequence.recording);
  const auto all = remarks(report);
  EXPECT_TRUE(
      std::is_sorted(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.kind < b.kind; }));
}

}  // namespace
}  // namespace relock
