#include <sstream>

#include "eval/replay/answers_csv.h"
#include "eval/trajectory_csv.h"
#include "tests/eval/random_timelines.h"
#include "tests/mangled.h"

namespace relock {
namespace {

TEST(MangledTrajectory, IsTakenOrRefusedInASentence) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Case c = random_case(seed);
    std::ostringstream text;
    write_trajectory(text, c.recording, c.trajectory);
    expect_taken_or_refused(
        text.str(), "trajectory.csv",
        [&](const std::string& copy) {
          std::istringstream in(copy);
          Trajectory read = c.trajectory;
          read_trajectory(in, "trajectory.csv", c.recording, read);
          ASSERT_LE(read.frames.size(), c.recording.frames());
        },
        1000);
  }
}

TEST(MangledAnswers, AreTakenOrRefusedInASentence) {
  const Case c = random_case(1);
  std::vector<Answer> answers;
  for (std::size_t k = 0; k < c.recording.frames(); k += 2)
    answers.push_back({static_cast<FrameIndex>(k), c.recording.captured[k],
                       c.recording.captured[k] + std::chrono::milliseconds(20)});
  std::ostringstream text;
  write_answers(text, answers);
  expect_taken_or_refused(text.str(), "answers.csv", [&](const std::string& copy) {
    std::istringstream in(copy);
    read_answers(in, "answers.csv", c.recording);
  });
}

TEST(MangledLatencies, AreTakenOrRefusedInASentence) {
  expect_taken_or_refused("frame,wall_ms,cpu_ms\n0,1.5,1\n3,20,19\n7,4.25,4\n", "timing.csv",
                          [](const std::string& copy) {
                            std::istringstream in(copy);
                            read_latencies(in, "timing.csv");
                          });
}

}  // namespace
}  // namespace relock
