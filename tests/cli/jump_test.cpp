#include "cli/jump/jumps.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "cli/jump/curve.h"

namespace relock::jumps {
namespace {

constexpr double kSize = 40;

/// A target of kSize px that moves by `step` of its size from frame to frame.
Recording steady(double step, std::size_t frames) {
  Recording recording;
  recording.name = "steady", recording.picture = {4000, 480},
  recording.period = std::chrono::milliseconds(40);
  recording.targets = {{"one", {}, {}}};
  for (std::size_t frame = 0; frame < frames; ++frame) {
    recording.captured.push_back(Time{} + static_cast<std::int64_t>(frame) * recording.period);
    TargetTruth truth;
    truth.label = Label::visible;
    truth.outline = Box{100 + step * kSize * static_cast<double>(frame), 100, kSize, kSize};
    recording.truth.push_back(truth);
  }
  return recording;
}

TEST(Jumps, GoAsFarAsTheTargetDoesOverTheGap) {
  const JumpTest test;
  const auto jumps = jumps_in(steady(0.1, 200), test);
  ASSERT_FALSE(jumps.empty());
  for (const Jump& jump : jumps) {
    EXPECT_NEAR(jump.distance, 0.1 * (jump.missing + 1), 1e-9);
    EXPECT_GE(jump.distance, test.edges[jump.bin]);
    EXPECT_LT(jump.distance, test.edges[jump.bin + 1]);
  }
}

TEST(Jumps, OfOneBinShareNoFrame) {
  const JumpTest test;
  std::map<std::size_t, FrameIndex> free_from;
  for (const Jump& jump : jumps_in(steady(0.13, 300), test)) {
    EXPECT_GE(jump.start, free_from[jump.bin]);
    free_from[jump.bin] = jump.start + test.window();
  }
}

TEST(Jumps, AreNotTriedWhereTheTargetIsNotVisibleAfterwards) {
  Recording recording = steady(0.1, 28);
  const auto before = jumps_in(recording, {}).size();
  ASSERT_GT(before, 0U);
  recording.truth.back().label = Label::absent;  // only the longest gap ends there
  for (const Jump& jump : jumps_in(recording, {})) EXPECT_LT(jump.missing, 14);
  recording.truth[9].label = Label::absent;  // within every gap but the shortest, and nobody looks there
  for (const Jump& jump : jumps_in(recording, {})) EXPECT_GT(jump.missing, 0);
  recording.truth[8].label = Label::absent;  // the last frame before every gap
  EXPECT_TRUE(jumps_in(recording, {}).empty());
}

TEST(Jumps, TakeTheirTimeUnlessTheClockIsClosed) {
  const JumpTest test;
  const Recording recording = steady(0.1, 60);
  for (const Jump& jump : jumps_in(recording, test)) {
    const Scene kept = scene_of(recording, jump, test, Clock::kept),
                closed = scene_of(recording, jump, test, Clock::closed);
    EXPECT_EQ(kept.missing.size(), static_cast<std::size_t>(jump.missing));
    EXPECT_TRUE(closed.missing.empty());
    EXPECT_EQ(kept.frames.size(), closed.frames.size() + kept.missing.size());
    for (std::size_t i = 1; i < closed.frames.size(); ++i)
      EXPECT_EQ(closed.recording.captured[i] - closed.recording.captured[i - 1], recording.period);
    EXPECT_EQ(kept.frames[kept.held], closed.frames[closed.held]);
    EXPECT_EQ(kept.frames[kept.judged], closed.frames[closed.judged]);
    EXPECT_EQ(kept.recording.truth.back().outline, closed.recording.truth.back().outline);
  }
}

TEST(JumpCurve, CountsEveryJumpOnce) {
  Trial trial;
  trial.methods.resize(1);
  trial.methods.front().text = "method";
  trial.sequences.resize(1);
  trial.jumps = {
      {{0, 0, 1, 0.1, 0}, {0, 0, 2, 0.1, 0}, {0, 0, 3, 0.1, 0}, {0, 0, 4, 0.6, 2}, {0, 0, 5, 0.6, 2}}};
  const auto curves = curves_of(
      trial, {{{Outcome::held, Outcome::declared, Outcome::not_held, Outcome::silent, Outcome::failed}}});
  const auto& bins = curves.front().bins;
  EXPECT_EQ(bins[0].tried, 2);
  EXPECT_EQ(bins[0].lost, 1);
  EXPECT_EQ(bins[0].declared, 1);
  EXPECT_EQ(bins[0].not_held, 1);
  EXPECT_EQ(bins[2].tried, 2);
  EXPECT_EQ(bins[2].lost, 2);
  EXPECT_EQ(bins[2].failed, 1);
  EXPECT_EQ(bins[1].tried, 0);
}

}  // namespace
}  // namespace relock::jumps
