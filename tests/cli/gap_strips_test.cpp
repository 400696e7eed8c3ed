#include "cli/reproduce/gap_strips.h"

#include <gtest/gtest.h>

#include "tests/cli/made_comparison.h"

namespace relock::reproduction {
namespace {

StripFrames strip_of(const std::string& letters) {
  const ScoredComparison runs = scored(made_comparison("flight", {{"blut", {letters}}}), Gate{});
  return strip_frames(runs.stored.recording, runs.evaluations.front().targets.front());
}

TEST(AStrip, ShowsTheFramesAboutTheFirstLoss) {
  const StripFrames shown =
      strip_of(std::string(20, 'H') + std::string(10, 'S') + std::string(10, 'H') + std::string(10, 'S'));
  EXPECT_TRUE(shown.loss);
  EXPECT_EQ(shown.frames, (std::vector<FrameIndex>{18, 19, 20, 21, 22}));
}

TEST(AStrip, EndsWithTheRecording) {
  const StripFrames shown = strip_of(std::string(20, 'H') + std::string(3, 'S'));
  EXPECT_TRUE(shown.loss);
  EXPECT_EQ(shown.frames, (std::vector<FrameIndex>{18, 19, 20, 21, 22}));
  EXPECT_EQ(strip_of(std::string(3, 'H')).frames, (std::vector<FrameIndex>{0, 1, 2}));
}

TEST(AStrip, ShowsTheLongestStepWhereNothingIsLost) {
  StoredComparison made = made_comparison("flight", {{"blut", {std::string(30, 'H')}}});
  Box moved = bounds(*made.recording.truth_of(12, 0).outline);
  moved.x += 5;
  for (std::size_t frame = 12; frame < 30; ++frame) made.recording.truth_of(frame, 0).outline = moved;
  const ScoredComparison runs = scored(std::move(made), Gate{});
  const StripFrames shown = strip_frames(runs.stored.recording, runs.evaluations.front().targets.front());
  EXPECT_FALSE(shown.loss);
  EXPECT_EQ(shown.frames, (std::vector<FrameIndex>{10, 11, 12, 13, 14}));
}

}  // namespace
}  // namespace relock::reproduction
