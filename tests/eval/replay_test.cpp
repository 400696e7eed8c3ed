#include "eval/replay/replay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>

#include "core/error.h"
#include "core/random.h"
#include "eval/judgement/evaluation.h"
#include "eval/replay/yardsticks.h"
#include "eval/trajectory_csv.h"
#include "tests/eval/made_flight.h"
#include "tests/eval/random_timelines.h"

namespace relock {
namespace {

Replay replayed(Method& method, const Recording& recording, Protocol protocol,
                const std::vector<std::size_t>& dropped = {}) {
  MadeFrames frames(recording);
  Schedule schedule(recording.frames());
  for (const std::size_t frame : dropped) schedule.drop(frame);
  ReplayOptions options;
  options.protocol = protocol;
  return replay(method, frames, recording, schedule, options);
}

/// As a replay keeps them: what is said twice in the same words is said once.
Sightings each_once(const Sightings& said) {
  Sightings once;
  for (const Sighting& sighting : said)
    if (std::find(once.begin(), once.end(), sighting) == once.end()) once.push_back(sighting);
  return once;
}

TEST(Start, IsOnTheFirstFrameThatShowsTheWholeTargetUnoccluded) {
  const Recording recording = made_flight("a?ovvv");
  Scripted method(nothing);
  const Replay done = replayed(method, recording, Protocol::once);
  EXPECT_EQ(method.started, std::vector<FrameIndex>{3});
  EXPECT_EQ(method.given, (Box{103, 100, 40, 40}));
  EXPECT_EQ(verdicts(recording, done.trajectory), "   gMM");
}

TEST(Start, IsLeftOutForMethodsThatTakeNoBox) {
  const Recording recording = made_flight("vvvv");
  Scripted method(nothing, Scripted::Boxes::not_taken);
  EXPECT_EQ(verdicts(recording, replayed(method, recording, Protocol::once).trajectory), " MMM");
  EXPECT_TRUE(method.started.empty());
  EXPECT_EQ(verdicts(recording, replayed(method, recording, Protocol::detect).trajectory), "MMMM");
}

TEST(Reset, StartsAgainOnTheFrameAfterTheLossIsDeclared) {
  const Recording recording = made_flight("vvvvvvvvv");
  Scripted method(nothing);
  EXPECT_EQ(verdicts(recording, replayed(method, recording, Protocol::reset).trajectory), "gMMMgMMMg");
}

TEST(Reset, WaitsForAFrameThatIsDeliveredAndStartable) {
  const Recording recording = made_flight("vvvvvovvv");
  Scripted method(nothing);
  EXPECT_EQ(verdicts(recording, replayed(method, recording, Protocol::reset, {4}).trajectory), "gMMM.MgMM");
}

TEST(Reset, WaitsForATargetThatLeftMeanwhile) {
  const Recording recording = made_flight("vvvvaaavvvv");
  Scripted method(nothing);
  EXPECT_EQ(verdicts(recording, replayed(method, recording, Protocol::reset).trajectory), "gMMMrrrgMMM");
}

TEST(Reset, IsNotNeededByAMethodThatRelocksInTime) {
  const Recording recording = made_flight("vvvvooovvv");
  Scripted method([&](const Frame& frame) -> Sightings {
    if (frame.index < 4) return {};
    return {sighting_of(*recording.truth_of(static_cast<std::size_t>(frame.index), 0).outline)};
  });
  EXPECT_EQ(verdicts(recording, replayed(method, recording, Protocol::reset).trajectory), "gMMMHHHHHH");
}

TEST(DroppedFrames, AreNeverShown) {
  const Recording recording = made_flight("vvvvvv");
  Scripted method(nothing);
  replayed(method, recording, Protocol::once, {2, 3});
  EXPECT_EQ(method.asked, (std::vector<FrameIndex>{0, 1, 4, 5}));
}

TEST(AMethodThatThrows, IsScoredAsFailedFromThereOn) {
  const Recording recording = made_flight("vvvvvv");
  Scripted method([](const Frame& frame) -> Sightings {
    if (frame.index == 3) throw std::runtime_error("no more");
    return {};
  });
  const Replay done = replayed(method, recording, Protocol::once);
  ASSERT_EQ(done.failures.size(), 1u);
  EXPECT_EQ(done.failures[0].frame, 3);
  EXPECT_EQ(verdicts(recording, done.trajectory), "gMMMMM");
  const auto judged = evaluate(recording, done.trajectory).targets[0].judgements;
  EXPECT_FALSE(judged[2].failed);
  EXPECT_TRUE(judged[3].failed && judged[5].failed);
  EXPECT_EQ(method.asked.back(), 3) << "it is not asked again";
}

TEST(AnAnswerThatIsNotFinite, IsAFailure) {
  const Recording recording = made_flight("vvv");
  Scripted method([](const Frame&) {
    Sighting bad = sighting_of(Box{0, 0, 10, 10});
    bad.centre.x = std::nan("");
    return Sightings{bad};
  });
  EXPECT_EQ(replayed(method, recording, Protocol::once).failures.at(0).frame, 0);
}

TEST(AnAnswer, WithABlurOrCodeThatNoFileCouldHoldIsAFailure) {
  const Recording recording = made_flight("vvv");
  for (int fault = 0; fault < 3; ++fault) {
    Scripted method([fault](const Frame&) {
      Sighting bad = sighting_of(Box{0, 0, 10, 10});
      if (fault == 0) bad.blur = BlurEstimate{std::nan(""), 1};
      if (fault == 1) bad.code = Code{"family", ""};
      if (fault == 2) bad.confidence = 7;
      return Sightings{bad};
    });
    EXPECT_EQ(replayed(method, recording, Protocol::once).failures.size(), 1u);
  }
}

TEST(AnAnswer, ThatIsSaidTwiceInTheSameWordsIsSaidOnce) {
  const Recording recording = made_flight("vvv");
  Scripted method([](const Frame& frame) {
    const Sighting seen = sighting_of(Box{100, 100, 40, 40}),
                   other = sighting_of(Box{100, 100 + 1.0 * static_cast<double>(frame.index), 40, 40});
    return Sightings{seen, seen, other};
  });
  const Replay done = replayed(method, recording, Protocol::once);
  EXPECT_EQ(done.trajectory.frames[1].sightings.size(), 2u);
  EXPECT_EQ(done.trajectory.frames[2].sightings.size(), 2u);
}

TEST(ARecordingThatCannotBeReadOn, KeepsWhatCameBefore) {
  const Recording recording = made_flight("vvvvvv");
  MadeFrames frames(recording, 4);
  const auto method = oracle(recording);
  const Replay done = replay(*method, frames, recording, Schedule(6), {});
  ASSERT_TRUE(done.cut_short);
  EXPECT_EQ(done.cut_short->frame, 4);
  EXPECT_EQ(done.trajectory.frames.size(), 4u);
}

TEST(Trajectory, IsTheSameAfterWritingAndReading) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Case c = random_case(seed);
    for (FrameReport& report : c.trajectory.frames) report.sightings = each_once(report.sightings);
    // A file has four decimals: what is written once can be read and written again without a change.
    std::ostringstream once, twice;
    write_trajectory(once, c.recording, c.trajectory);
    Trajectory back = c.trajectory;
    std::istringstream in(once.str());
    read_trajectory(in, "trajectory.csv", c.recording, back);
    write_trajectory(twice, c.recording, back);
    ASSERT_EQ(once.str(), twice.str()) << "seed " << seed;
    ASSERT_EQ(back.frames.size(), c.trajectory.frames.size());
  }
}

TEST(TrajectoryReader, RefusesARowThatIsThereTwice) {
  const Recording recording = made_flight("vvvvv");
  Scripted method([](const Frame& frame) {
    return frame.index == 2 ? Sightings{} : Sightings{sighting_of(Box{100, 100, 40, 40})};
  });
  Trajectory trajectory = replayed(method, recording, Protocol::once, {3}).trajectory;
  std::ostringstream out;
  write_trajectory(out, recording, trajectory);
  std::vector<std::string> lines;
  std::istringstream whole(out.str());
  for (std::string line; std::getline(whole, line);) lines.push_back(line + "\n");
  for (std::size_t twice = 1; twice < lines.size(); ++twice) {
    std::string text;
    for (std::size_t i = 0; i < lines.size(); ++i) text += i == twice ? lines[i] + lines[i] : lines[i];
    std::istringstream in(text);
    Trajectory back = trajectory;
    try {
      read_trajectory(in, "trajectory.csv", recording, back);
      ADD_FAILURE() << lines[twice] << "is read twice";
    } catch (const Error& fault) {
      EXPECT_TRUE(std::string(fault.what()).starts_with("trajectory.csv:" + std::to_string(twice + 2) + ": "))
          << fault.what();
    }
  }
}

TEST(TrajectoryReader, EndsInAnErrorOrNotAtAllOnAnyBytes) {
  const Case c = random_case(7);
  std::ostringstream out;
  write_trajectory(out, c.recording, c.trajectory);
  Random random(23);
  const std::string alphabet = "0123456789.,,\n\"-agn";
  for (int i = 0; i < 2000; ++i) {
    std::string text = out.str();
    for (auto n = 1 + random.below(3); n > 0; --n)
      text[random.below(text.size())] = alphabet[random.below(alphabet.size())];
    Trajectory back = c.trajectory;
    std::istringstream in(text);
    try {
      read_trajectory(in, "trajectory.csv", c.recording, back);
    } catch (const Error&) {
    }
  }
}

}  // namespace
}  // namespace relock
