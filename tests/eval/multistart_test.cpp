#include "eval/replay/multistart.h"

#include <gtest/gtest.h>

#include <sstream>

#include "core/error.h"
#include "eval/judgement/evaluation.h"
#include "eval/replay/replay.h"
#include "eval/replay/yardsticks.h"
#include "eval/trajectory_csv.h"
#include "tests/eval/made_flight.h"
#include "tests/eval/random_timelines.h"

namespace relock {
namespace {

std::string spoken(const std::vector<Anchor>& all) {
  std::string text;
  for (const Anchor& anchor : all) text += (text.empty() ? "" : ", ") + to_string(anchor);
  return text;
}

TEST(Anchors, AreEveryFiftyFramesBothWaysAsLongAsFramesAreLeft) {
  EXPECT_EQ(spoken(anchors(made_flight(std::string(53, 'v')))), "frame 0 forward, frame 50 backward");
  EXPECT_EQ(spoken(anchors(made_flight(std::string(125, 'v')))),
            "frame 0 forward, frame 50 forward, frame 50 backward, frame 100 forward, frame 100 backward");
  EXPECT_EQ(spoken(anchors(made_flight(std::string(24, 'v')))), "");
}

TEST(Anchors, MoveOnToAFrameWhereATargetCanBeStarted) {
  std::string letters(84, 'v');
  letters.replace(50, 4, "aao?");
  EXPECT_EQ(spoken(anchors(made_flight(letters))), "frame 0 forward, frame 54 forward, frame 54 backward");
}

TEST(Anchors, ThatMeetAreOneAndThoseThatFindNothingAreNone) {
  const std::string away(70, 'a');
  EXPECT_EQ(spoken(anchors(made_flight(away + std::string(40, 'v')), {.every = 20, .fewest = 1})),
            "frame 70 forward, frame 70 backward, frame 80 forward, frame 80 backward, frame 100 forward, "
            "frame 100 "
            "backward");
  EXPECT_EQ(spoken(anchors(made_flight(std::string(10, 'v') + away), {.every = 20, .fewest = 10})),
            "frame 0 forward");
}

TEST(AReflectedRecording, IsItselfWhenReflectedAgain) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Recording recording = random_case(seed).recording;
    recording.truth.front().blur = Vec2{3, -1};
    const Recording twice = reflected(reflected(recording));
    EXPECT_EQ(twice.captured, recording.captured);
    for (std::size_t i = 0; i < recording.truth.size(); ++i) {
      EXPECT_EQ(twice.truth[i].label, recording.truth[i].label);
      EXPECT_EQ(twice.truth[i].outline, recording.truth[i].outline);
      EXPECT_EQ(twice.truth[i].blur, recording.truth[i].blur);
    }
  }
}

TEST(AReflectedRecording, KeepsEveryIntervalAndTurnsBlurRound) {
  Recording recording = made_flight("vvv");
  recording.captured = {time_ns(100), time_ns(110), time_ns(150)};
  recording.truth_of(2, 0).blur = Vec2{3, -1};
  const Recording turned = reflected(recording);
  EXPECT_EQ(turned.captured, (std::vector<Time>{time_ns(100), time_ns(140), time_ns(150)}));
  EXPECT_EQ(turned.truth_of(0, 0).blur, (Vec2{-3, 1}));
  EXPECT_EQ(turned.truth_of(0, 0).outline, recording.truth_of(2, 0).outline);
}

/// Says nothing, and remembers what it was shown.
TEST(ARunFromAnAnchor, SeesNothingBeforeIt) {
  const Recording recording = reflected(made_flight("vvvvvvvv"));
  MadeFrames frames(recording);
  Scripted method(nothing);
  ReplayOptions options;
  options.protocol = Protocol::multistart;
  options.from = start_of({5, Direction::backward}, recording.frames());
  const Replay done = replay(method, frames, recording, Schedule(recording.frames()), options);
  EXPECT_EQ(method.started, std::vector<FrameIndex>{2});
  EXPECT_EQ(method.given, bounds(Box{105, 100, 40, 40})) << "where the target was on recorded frame 5";
  EXPECT_EQ(method.asked, (std::vector<FrameIndex>{2, 3, 4, 5, 6, 7}));
  EXPECT_EQ(verdicts(recording, done.trajectory), "  gMMMMM");
}

TEST(ATrajectory, KeepsWithheldFramesInItsFile) {
  const Recording recording = made_flight("vvvvvv");
  MadeFrames frames(recording);
  Scripted method(nothing);
  ReplayOptions options;
  options.from = 3;
  const Replay done = replay(method, frames, recording, Schedule(recording.frames()), options);
  std::stringstream file;
  write_trajectory(file, recording, done.trajectory);
  Trajectory read = done.trajectory;
  read_trajectory(file, "trajectory.csv", recording, read);
  for (std::size_t frame = 0; frame < recording.frames(); ++frame)
    EXPECT_EQ(read.frames[frame].withheld.size(), frame < 3 ? 1u : 0u);
  EXPECT_EQ(verdicts(recording, read), "   gMM");
}

TEST(ARunFromAnAnchor, OfThePerfectMethodHitsEveryFrameAfterIt) {
  const Recording recording = reflected(made_flight("vvvvvv"));
  MadeFrames frames(recording);
  const auto method = oracle(recording);
  ReplayOptions options;
  options.from = 1;
  EXPECT_EQ(verdicts(recording,
                     replay(*method, frames, recording, Schedule(recording.frames()), options).trajectory),
            " gHHHH");
}

TEST(AReflectedSchedule, DropsTheSamePictures) {
  Schedule schedule(5);
  schedule.drop(1);
  const Schedule turned = reflected(schedule);
  for (std::size_t frame = 0; frame < 5; ++frame) EXPECT_EQ(turned.delivered(frame), frame != 3);
}

}  // namespace
}  // namespace relock
