#include "eval/replay/real_time.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <sstream>

#include "core/error.h"
#include "core/random.h"
#include "eval/replay/answers_csv.h"
#include "eval/replay/replay.h"
#include "eval/replay/yardsticks.h"
#include "eval/scores/in_force.h"
#include "tests/eval/made_flight.h"
#include "tests/eval/random_timelines.h"

namespace relock {
namespace {

using Frames = std::vector<FrameIndex>;

/// Frames every 10 ns.
std::vector<Time> tens(std::size_t frames) {
  std::vector<Time> all;
  for (std::size_t i = 0; i < frames; ++i) all.push_back(time_ns(static_cast<std::int64_t>(10 * i)));
  return all;
}

/// The frames that a method comes to which takes `latency_ns` over each.
Frames come_to(const std::string& waiting, std::int64_t latency_ns, std::size_t frames,
               const Frames& dropped = {}) {
  const auto captured = tens(frames);
  Schedule schedule(frames);
  for (const FrameIndex frame : dropped) schedule.drop(static_cast<std::size_t>(frame));
  VirtualClock clock(captured, schedule, parse_waiting(waiting));
  Frames all;
  for (FrameIndex frame = 0; frame < static_cast<FrameIndex>(frames); ++frame) {
    if (!clock.comes_to(frame)) continue;
    all.push_back(frame);
    clock.answered(frame, Duration(latency_ns));
  }
  return all;
}

TEST(TheLatestFrame, IsTheOneThatABusyMethodComesToNext) {
  EXPECT_EQ(come_to("latest", 0, 4), (Frames{0, 1, 2, 3}));
  EXPECT_EQ(come_to("latest", 10, 4), (Frames{0, 1, 2, 3})) << "frame 1 arrives in the moment it is ready";
  EXPECT_EQ(come_to("latest", 20, 7), (Frames{0, 2, 4, 6}));
  EXPECT_EQ(come_to("latest", 30, 7), (Frames{0, 3, 6}));
  // Ready at 25, 50, 75: frames 2, 5 and 7 are the newest then. Nothing takes the place of the last.
  EXPECT_EQ(come_to("latest", 25, 10), (Frames{0, 2, 5, 7, 9}));
}

TEST(AQueue, LosesItsOldestFrameWhenItIsFull) {
  // Ready at 25 with 1 2 waiting; at 50 with (2 3) 4 5, at 75 with (5) 6 7, at 100 with (7 8) 9 10.
  EXPECT_EQ(come_to("queue(2)", 25, 11), (Frames{0, 1, 4, 6, 9, 10}));
  EXPECT_EQ(come_to("queue(1)", 25, 10), come_to("latest", 25, 10));
  EXPECT_EQ(come_to("queue(100)", 25, 6), (Frames{0, 1, 2, 3, 4, 5}))
      << "a long one loses nothing, and is late";
}

TEST(DroppedFrames, NeverArrive) {
  EXPECT_EQ(come_to("latest", 20, 8, {2, 3}), (Frames{0, 1, 4, 6, 7})) << "at 20 only frame 1 is there";
  EXPECT_EQ(come_to("latest", 0, 4, {0, 3}), (Frames{1, 2}));
}

/// The same, told tick by tick: what arrives joins the queue, and a method that is ready takes its head.
Frames come_to_by_ticks(const std::vector<Time>& captured, const Schedule& schedule, std::size_t places,
                        const std::function<std::int64_t(FrameIndex)>& latency_ns) {
  Frames queue, taken;
  std::int64_t ready = ns(captured.front());
  std::size_t next = 0;
  for (std::int64_t tick = ready; next < captured.size() || !queue.empty(); ++tick) {
    for (; next < captured.size() && ns(captured[next]) == tick; ++next)
      if (schedule.delivered(next)) queue.push_back(static_cast<FrameIndex>(next));
    while (queue.size() > places) queue.erase(queue.begin());
    while (ready <= tick && !queue.empty()) {
      taken.push_back(queue.front());
      queue.erase(queue.begin());
      ready = tick + latency_ns(taken.back());
    }
  }
  return taken;
}

TEST(TheVirtualClock, AgreesWithOneThatTicks) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    Random random(seed);
    std::vector<Time> captured{time_ns(static_cast<std::int64_t>(random.below(5)))};
    while (captured.size() < 40)
      captured.push_back(captured.back() + Duration(1 + static_cast<std::int64_t>(random.below(12))));
    Schedule schedule(captured.size());
    for (std::size_t frame = 0; frame < captured.size(); ++frame)
      if (random.chance(0.2)) schedule.drop(frame);
    std::vector<std::int64_t> latencies;
    for (std::size_t frame = 0; frame < captured.size(); ++frame)
      latencies.push_back(static_cast<std::int64_t>(random.below(30)));
    const auto latency = [&](FrameIndex frame) { return latencies[static_cast<std::size_t>(frame)]; };
    const std::size_t places = 1 + random.below(4);
    VirtualClock clock(captured, schedule, {places});
    Frames taken;
    for (FrameIndex frame = 0; frame < 40; ++frame) {
      if (!clock.comes_to(frame)) continue;
      taken.push_back(frame);
      clock.answered(frame, Duration(latency(frame)));
    }
    EXPECT_EQ(taken, come_to_by_ticks(captured, schedule, places, latency)) << "seed " << seed;
  }
}

TEST(Answers, FinishALatencyAfterTheMethodComesToTheFrame) {
  const auto captured = tens(4);
  const Schedule schedule(4);
  VirtualClock clock(captured, schedule, parse_waiting("queue(3)"));
  EXPECT_EQ(clock.answered(0, Duration(15)), (Answer{0, time_ns(0), time_ns(15)}));
  EXPECT_EQ(clock.answered(1, Duration(3)), (Answer{1, time_ns(10), time_ns(18)}))
      << "it waited from 10 to 15";
  EXPECT_EQ(clock.answered(2, Duration(1)), (Answer{2, time_ns(20), time_ns(21)}));
  EXPECT_THROW(clock.answered(2, Duration(1)), Error);
}

TEST(Latency, IsAsItIsTyped) {
  EXPECT_EQ(parse_latency("constant(20ms)").of(7, Duration(1)), std::chrono::milliseconds(20));
  EXPECT_EQ(parse_latency("constant(0.02s)").text, "constant(20ms)");
  EXPECT_EQ(parse_latency("constant(0us)").of(7, Duration(1)), Duration(0));
  EXPECT_EQ(parse_latency("measured").of(7, Duration(42)), Duration(42));
  for (const char* wrong : {"constant(20)", "constant(-1ms)", "constant(nanms)", "constant(ms)", "fast", ""})
    EXPECT_THROW(parse_latency(wrong), Error) << wrong;
  for (const char* wrong : {"queue(0)", "queue(1.5)", "queue()", "queue(-1)", "queue(1e9)", "newest"})
    EXPECT_THROW(parse_waiting(wrong), Error) << wrong;
}

TEST(ListedLatencies, HoldUntilTheNextOneThatIsListed) {
  std::istringstream file("frame,wall_ms,cpu_ms\n3,10,9\n5,2.5,2\n");
  const Latency latency = read_latencies(file, "timing.csv");
  const auto ms = [&](FrameIndex frame) { return 1e3 * seconds(latency.of(frame, Duration(0))); };
  EXPECT_EQ(ms(0), 10);
  EXPECT_EQ(ms(4), 10);
  EXPECT_EQ(ms(5), 2.5);
  EXPECT_EQ(ms(99), 2.5);
  for (const char* wrong : {"frame,wall_ms\n", "frame,wall_ms\n1,-2\n", "frame,wall_ms\n2,1\n1,1\n"}) {
    std::istringstream faulty(wrong);
    EXPECT_THROW(read_latencies(faulty, "timing.csv"), Error) << wrong;
  }
}

// Replay and what is in force.

/// A target of 40 px that moves 15 px a frame: an answer is no Hit any more on the next one.
Recording fast_flight(const std::string& letters) {
  Recording recording = made_flight(letters);
  recording.period = std::chrono::milliseconds(30);
  for (std::size_t i = 0; i < recording.frames(); ++i) {
    recording.captured[i] = Time{static_cast<std::int64_t>(i) * recording.period};
    if (auto& outline = recording.truth_of(i, 0).outline)
      outline = Box{15 * static_cast<double>(i), 100, 40, 40};
  }
  return recording;
}

Replay in_real_time(Method& method, const Recording& recording, const std::string& latency,
                    const Frames& dropped = {}, Protocol protocol = Protocol::once) {
  MadeFrames frames(recording);
  Schedule schedule(recording.frames());
  for (const FrameIndex frame : dropped) schedule.drop(static_cast<std::size_t>(frame));
  ReplayOptions options;
  options.protocol = protocol;
  options.real_time = RealTime{{}, parse_latency(latency)};
  return replay(method, frames, recording, schedule, options);
}

std::string in_force_verdicts(const Recording& recording, const Replay& done) {
  return verdicts(recording, in_force(recording, done.trajectory, done.answers).trajectory);
}

/// "2 slowness, 0 gaps, 3 failure".
std::string lost(const Recording& recording, const Replay& done) {
  const auto scores = score_real_time(recording, done.trajectory, done.answers).at(0);
  std::ostringstream text;
  text << scores.lost[0] << " slowness, " << scores.lost[1] << " gaps, " << scores.lost[2] << " failure";
  return text.str();
}

TEST(RealTime, SkipsEverySecondFrameOfAMethodThatTakesTwoPeriods) {
  const Recording recording = fast_flight("vvvvvvv");
  Scripted method(nothing);
  EXPECT_EQ(verdicts(recording, in_real_time(method, recording, "constant(60ms)").trajectory), "g-M-M-M");
  EXPECT_EQ(verdicts(recording, in_real_time(method, recording, "constant(90ms)").trajectory), "g--M--M");
  EXPECT_EQ(verdicts(recording, in_real_time(method, recording, "constant(30ms)").trajectory), "gMMMMMM");
}

TEST(RealTime, TakesNoTimeBeforeTheFirstStart) {
  const Recording recording = fast_flight("aaavvv");
  Scripted method(nothing);
  EXPECT_EQ(verdicts(recording, in_real_time(method, recording, "constant(60ms)").trajectory), "   g-M");
}

TEST(RealTime, StartsASecondTargetWhenTheMethodComesToIt) {
  Recording recording = fast_flight("vvvvvvv");
  recording.targets.push_back({"second"});
  std::vector<TargetTruth> truth;
  for (std::size_t frame = 0; frame < recording.frames(); ++frame) {
    truth.push_back(recording.truth[frame]);
    truth.push_back(recording.truth[frame]);
    if (frame < 3) truth.back().label = Label::absent;
  }
  recording.truth = truth;
  Scripted method(nothing);
  const Replay done = in_real_time(method, recording, "constant(60ms)");
  EXPECT_EQ(verdicts(recording, done.trajectory, 0), "g-M-M-M");
  EXPECT_EQ(verdicts(recording, done.trajectory, 1), "   -g-M");
}

TEST(ARestart, ComesOnTheFirstFrameThatTheMethodComesToAfterTheLoss) {
  const Recording recording = fast_flight("vvvvvvvvvvvvv");
  Scripted method(nothing);
  const Replay done = in_real_time(method, recording, "constant(60ms)", {}, Protocol::reset);
  EXPECT_EQ(verdicts(recording, done.trajectory), "g-M-M-M-g-M-M");
}

TEST(AnswersInForce, AreTheMethodsOwnWhenTheyTakeNoTime) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Case drawn = random_case(seed);
    std::vector<Answer> answers;
    for (std::size_t frame = 0; frame < drawn.recording.frames(); ++frame) {
      FrameReport& report = drawn.trajectory.frames[frame];
      report.withheld.clear();
      const Time captured = drawn.recording.captured[frame];
      if (report.delivery == Delivery::delivered)
        answers.push_back({static_cast<FrameIndex>(frame), captured, captured});
    }
    for (auto& failed : drawn.trajectory.failed_from) failed.reset();
    const InForce held = in_force(drawn.recording, drawn.trajectory, answers);
    const Evaluation own = evaluate(drawn.recording, drawn.trajectory);
    const Evaluation judged = evaluate(drawn.recording, held.trajectory);
    for (std::size_t frame = 0; frame < drawn.recording.frames(); ++frame) {
      if (drawn.trajectory.frames[frame].delivery != Delivery::delivered) continue;
      EXPECT_EQ(held.answer_age_s[frame], 0);
      for (std::size_t t = 0; t < drawn.recording.targets.size(); ++t)
        EXPECT_EQ(judged.targets[t].judgements[frame], own.targets[t].judgements[frame]) << "seed " << seed;
    }
  }
}

TEST(AnswersInForce, AndWhatIsLostAddUpToTheVisibleFrames) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Case drawn = random_case(seed);
    Random random(seed);
    Schedule schedule(drawn.recording.frames());
    for (std::size_t frame = 0; frame < drawn.recording.frames(); ++frame) {
      drawn.trajectory.frames[frame].withheld.clear();
      if (drawn.trajectory.frames[frame].delivery != Delivery::delivered) schedule.drop(frame);
    }
    VirtualClock clock(drawn.recording.captured, schedule, {1 + random.below(3)});
    std::vector<Answer> answers;
    for (std::size_t frame = 0; frame < drawn.recording.frames(); ++frame)
      if (clock.comes_to(static_cast<FrameIndex>(frame)))
        answers.push_back(
            clock.answered(static_cast<FrameIndex>(frame), Duration(random.below(200'000'000))));
    const auto scores = score_real_time(drawn.recording, drawn.trajectory, answers);
    for (std::size_t t = 0; t < scores.size(); ++t) {
      const RealTimeScores& s = scores[t];
      std::size_t visible = 0;
      for (std::size_t frame = 0; frame < drawn.recording.frames(); ++frame) {
        const auto& from = drawn.trajectory.judged_from[t];
        const auto& given = drawn.trajectory.frames[frame].given;
        visible += drawn.recording.truth_of(frame, t).label == Label::visible && from &&
                           *from <= static_cast<FrameIndex>(frame) &&
                           std::find(given.begin(), given.end(), t) == given.end()
                       ? 1
                       : 0;
      }
      EXPECT_EQ(s.in_force, visible);
      EXPECT_EQ(s.hits + s.lost[0] + s.lost[1] + s.lost[2], s.in_force);
      EXPECT_EQ(s.answer_age_s.size(), s.in_force);
    }
  }
}

TEST(APerfectMethod, ThatIsSlowLosesToSlownessAlone) {
  const Recording recording = fast_flight("vvvvvvvv");
  const auto method = oracle(recording);
  const Replay done = in_real_time(*method, recording, "constant(60ms)");
  EXPECT_EQ(verdicts(recording, done.trajectory), "g-H-H-HH") << "nothing takes the place of the last frame";
  // Nothing is there at 1 and 2; then the answers to frames 2, 4 and 6, a frame old or two.
  EXPECT_EQ(in_force_verdicts(recording, done), "gMMSSSSS");
  EXPECT_EQ(lost(recording, done), "7 slowness, 0 gaps, 0 failure");
  const auto age = score_real_time(recording, done.trajectory, done.answers).at(0).answer_age_s;
  EXPECT_EQ(std::vector<double>(age.begin() + 2, age.end()),
            (std::vector<double>{0.03, 0.06, 0.03, 0.06, 0.03}));
}

TEST(APerfectMethod, ThatIsFastLosesOnlyToGaps) {
  const Recording recording = fast_flight("vvvvvvvv");
  const auto method = oracle(recording);
  const Replay done = in_real_time(*method, recording, "constant(0ms)", {3, 4});
  EXPECT_EQ(in_force_verdicts(recording, done), "gHHSSHHH");
  EXPECT_EQ(lost(recording, done), "0 slowness, 2 gaps, 0 failure");
}

TEST(AMethodThatIsWrong, LosesToFailureOnceItHasAnswered) {
  const Recording recording = fast_flight("vvvvvvvv");
  Scripted method([](const Frame&) {
    Sighting wrong = sighting_of(Box{500, 300, 40, 40});
    wrong.track = "target";
    return Sightings{wrong};
  });
  EXPECT_EQ(lost(recording, in_real_time(method, recording, "constant(60ms)")),
            "2 slowness, 0 gaps, 5 failure");
}

TEST(AMethodThatCrashes, LosesToFailureFromThereOn) {
  const Recording recording = fast_flight("vvvvvvvv");
  Scripted method([&](const Frame& frame) -> Sightings {
    if (frame.index == 4) throw std::runtime_error("no more");
    return {sighting_of(*recording.truth_of(static_cast<std::size_t>(frame.index), 0).outline)};
  });
  const Replay done = in_real_time(method, recording, "constant(10ms)");
  EXPECT_EQ(done.answers.size(), 4u);
  EXPECT_EQ(in_force_verdicts(recording, done), "gHHHMMMM");
  EXPECT_EQ(lost(recording, done), "0 slowness, 0 gaps, 4 failure");
  EXPECT_TRUE(std::isinf(in_force(recording, done.trajectory, done.answers).answer_age_s[4]));
}

TEST(AnAnswerToAnEmptyFrame, IsStaleAndNotWrongWhenTheTargetComesBack) {
  const Recording recording = fast_flight("vaaavvv");
  Scripted method([&](const Frame& frame) -> Sightings {
    const TargetTruth& truth = recording.truth_of(static_cast<std::size_t>(frame.index), 0);
    if (!truth.outline) return {};
    return {sighting_of(*truth.outline)};
  });
  // Frames 0, 2, 4 and 6 are seen; at 4 the answer to 2 is in force, which was right to say nothing.
  EXPECT_EQ(lost(recording, in_real_time(method, recording, "constant(60ms)")),
            "3 slowness, 0 gaps, 0 failure");
}

TEST(AnswersCsv, IsReadBackAndRefusesWhatCannotBe) {
  const Recording recording = fast_flight("vvvv");
  const std::vector<Answer> answers{{0, time_ns(0), time_ns(50'000'000)},
                                    {1, time_ns(30'000'000), time_ns(60'000'000)}};
  std::stringstream file;
  write_answers(file, answers);
  EXPECT_EQ(read_answers(file, "answers.csv", recording), answers);
  const std::string header = "frame,arrival_ns,finished_ns\n";
  for (const char* wrong : {"9,270000000,270000000\n", "0,5,6\n", "1,30000000,20000000\n",
                            "1,30000000,40000000\n0,0,50000000\n", "0,0,90000000\n1,30000000,40000000\n"}) {
    std::istringstream faulty(header + wrong);
    EXPECT_THROW(read_answers(faulty, "answers.csv", recording), Error) << wrong;
  }
}

}  // namespace
}  // namespace relock
