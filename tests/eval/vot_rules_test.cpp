#include "eval/replay/vot_rules.h"

#include <gtest/gtest.h>

#include <functional>

#include "eval/judgement/evaluation.h"
#include "eval/replay/replay.h"
#include "eval/replay/yardsticks.h"
#include "eval/timeline_text.h"
#include "tests/eval/made_flight.h"

namespace relock {
namespace {

/// The target of a made flight, and a second one that does not move.
Recording two_targets(const std::string& letters) {
  Recording recording = made_flight(letters);
  recording.targets.push_back({"second"});
  std::vector<TargetTruth> truth;
  for (const TargetTruth& of_first : recording.truth) {
    truth.push_back(of_first);
    truth.push_back(of_first);
    truth.back().outline = Box{400, 200, 40, 40};
  }
  recording.truth = truth;
  return recording;
}

Sighting tracked(const std::string& target, const Outline& outline) {
  Sighting sighting = sighting_of(outline);
  sighting.track = target;
  return sighting;
}

Replay by_vot(Method& method, const Recording& recording, const std::vector<std::size_t>& dropped = {}) {
  MadeFrames frames(recording);
  Schedule schedule(recording.frames());
  for (const std::size_t frame : dropped) schedule.drop(frame);
  ReplayOptions options;
  options.protocol = Protocol::vot;
  return replay(method, frames, recording, schedule, options);
}

/// Special codes as in VOT's result files; T tracked, u unjudged.
std::string codes(const Recording& recording, const Trajectory& trajectory) {
  std::string line;
  for (const VotFrame frame : vot_frames(recording, trajectory, 0)) line += "012Tu"[static_cast<int>(frame)];
  return line;
}

TEST(Vot, StartsAgainFiveFramesAfterAFailureAndShowsNothingBetween) {
  const Recording recording = made_flight("vvvvvvvvvvvvvv");
  Scripted method(nothing);
  const Replay done = by_vot(method, recording);
  EXPECT_EQ(codes(recording, done.trajectory), "12000012000012");
  EXPECT_EQ(verdicts(recording, done.trajectory), "gM    gM    gM");
  EXPECT_EQ(method.started, (std::vector<FrameIndex>{0, 6, 12}));
  EXPECT_EQ(method.asked, (std::vector<FrameIndex>{0, 1, 6, 7, 12, 13}));
}

TEST(Vot, WaitsForAFrameThatIsDeliveredAndStartable) {
  const Recording recording = made_flight("vvvvvvovvv");
  Scripted method(nothing);
  EXPECT_EQ(codes(recording, by_vot(method, recording, {7}).trajectory), "1200000012");
}

TEST(Vot, CallsNoFrameAFailureThatWasDroppedOrDoesNotShowTheTarget) {
  const Recording recording = made_flight("vvaa?vvvv");
  Scripted method([&](const Frame& frame) -> Sightings {
    const TargetTruth& truth = recording.truth_of(static_cast<std::size_t>(frame.index), 0);
    if (!truth.outline) return {};
    return {sighting_of(*truth.outline)};
  });
  const Replay done = by_vot(method, recording, {6});
  EXPECT_EQ(codes(recording, done.trajectory), "1TuuuTuTT");
  EXPECT_EQ(method.started.size(), 1u);
}

TEST(Vot, FailsOnlyWhenNothingAtAllIsCovered) {
  const Recording recording = made_flight("vvv");  // on frame 1 the target covers x 101 to 141
  const auto missed = [&](const Outline& said) {
    FrameReport report;
    report.sightings = {tracked("target", said)};
    return misses_by_vot(recording, 1, 0, report);
  };
  EXPECT_FALSE(missed(Box{140.9, 100, 40, 40}));
  EXPECT_TRUE(missed(Box{141, 100, 40, 40})) << "edges that touch cover nothing";
  EXPECT_TRUE(missed(Box{0, 0, 50, 50}));
}

TEST(Vot, SeesNoOverlapOutsideThePicture) {
  Recording recording = made_flight("vv");
  recording.truth_of(1, 0).outline = Box{-30, 100, 40, 40};
  FrameReport report;
  report.sightings = {tracked("target", Box{-40, 100, 35, 40})};
  EXPECT_TRUE(misses_by_vot(recording, 1, 0, report));
  report.sightings = {tracked("target", Box{-40, 100, 45, 40})};
  EXPECT_FALSE(misses_by_vot(recording, 1, 0, report));
}

TEST(Vot, TakesATurnedOutlineAsItIs) {
  Recording recording = made_flight("vv");
  recording.truth_of(1, 0).outline = Quad{{Vec2{100, 80}, Vec2{120, 100}, Vec2{100, 120}, Vec2{80, 100}}};
  FrameReport report;
  report.sightings = {tracked("target", Box{112, 80, 8, 6})};  // in the box around it, off its edge
  EXPECT_TRUE(misses_by_vot(recording, 1, 0, report));
}

TEST(Vot, LeavesTheOtherTargetsRunning) {
  const Recording recording = two_targets("vvvvvvvv");
  // The first tracker says a wrong place for ever: between failure and start nobody asks it.
  Scripted method([](const Frame&) {
    return Sightings{tracked("target", Box{10, 10, 40, 40}), tracked("second", Box{400, 200, 40, 40})};
  });
  const Replay done = by_vot(method, recording);
  EXPECT_EQ(verdicts(recording, done.trajectory, 0), "gS    gS");
  EXPECT_EQ(verdicts(recording, done.trajectory, 1), "gHHHHHHH");
  EXPECT_EQ(done.trajectory.frames[1].sightings.size(), 2u);
  EXPECT_EQ(done.trajectory.frames[2].sightings.size(), 1u);
}

TEST(Vot, IsToldInFailures) {
  const Recording recording = made_flight("vvvvvvvvvvvvvv");
  Scripted method(nothing);
  const Replay done = by_vot(method, recording);
  EXPECT_EQ(story(recording, done.trajectory, evaluate(recording, done.trajectory), 0),
            "3 failures, 2 started again");
}

TEST(Vot, NeverFailsAPerfectMethod) {
  const Recording recording = made_flight("avvvvaaavvv");
  const auto method = oracle(recording);
  EXPECT_EQ(codes(recording, by_vot(*method, recording).trajectory), "01TTTuuuTTT");
}

TEST(Vot, ScoresEveryFrameAfterACrashOfATargetThatWaits) {
  const Recording recording = two_targets("vvvvvvvv");
  // The first target fails on frame 1, and the method crashes on frame 3, before it is started again.
  Scripted method([](const Frame& frame) -> Sightings {
    if (frame.index == 3) throw std::runtime_error("no more");
    return {tracked("second", Box{400, 200, 40, 40})};
  });
  const Replay done = by_vot(method, recording);
  EXPECT_EQ(verdicts(recording, done.trajectory, 0), "gM  MMMM");
  EXPECT_EQ(verdicts(recording, done.trajectory, 1), "gHHMMMMM");
}

TEST(Vot, StartsNoMethodAgainThatHasCrashed) {
  const Recording recording = made_flight("vvvvvvvvvvvv");
  Scripted method([&](const Frame& frame) -> Sightings {
    if (frame.index == 2) throw std::runtime_error("no more");
    return {sighting_of(*recording.truth_of(static_cast<std::size_t>(frame.index), 0).outline)};
  });
  const Replay done = by_vot(method, recording);
  EXPECT_EQ(codes(recording, done.trajectory), "1T2000000000");
  EXPECT_EQ(verdicts(recording, done.trajectory), "gHMMMMMMMMMM") << "every frame after a crash is scored";
}

}  // namespace
}  // namespace relock
