#include "tests/eval/random_timelines.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "tests/eval/naive_evaluator.h"

namespace relock {
namespace {

constexpr std::uint64_t kSeeds = 2000;
constexpr int kOften = 50;

// How often everything that can happen does happen.
std::map<std::string, int> occurrences() {
  std::map<std::string, int> count;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const Case drawn = random_case(seed);
    const Evaluation evaluation = naive::evaluate(drawn.recording, drawn.trajectory, Gate{});
    for (const TargetTimeline& target : evaluation.targets) {
      for (const Judgement& judgement : target.judgements) {
        ++count["verdict " + std::to_string(static_cast<int>(judgement.verdict))];
        if (judgement.uncoded) ++count["uncoded"];
        if (judgement.failed) ++count["failed"];
        if (judgement.verdict == Verdict::Stray && judgement.hold) ++count["hold, no hit"];
      }
      for (const State state : target.states) ++count["state " + std::to_string(static_cast<int>(state))];
      for (const Loss& loss : target.losses) {
        ++count[loss.rule == LossRule::a ? "rule a" : "rule b"];
        ++count["kind " + std::to_string(static_cast<int>(loss.kind))];
        ++count["end " + std::to_string(static_cast<int>(loss.end))];
      }
      for (const Acquisition& search : target.acquisitions)
        ++count["search " + std::to_string(static_cast<int>(search.kind)) +
                (search.locked_at ? " found" : " vain")];
    }
    for (const int spurious : evaluation.spurious) count["spurious"] += spurious;
    for (const int ignored : evaluation.ignored) count["ignored"] += ignored;
  }
  return count;
}

TEST(RandomTimelines, HaveEverythingHappenOften) {
  const auto count = occurrences();
  for (const auto& [what, times] : count) RecordProperty(what, times);
  const auto expect = [&](const std::string& what) {
    const auto found = count.find(what);
    EXPECT_GE(found == count.end() ? 0 : found->second, kOften) << what;
  };
  for (std::size_t i = 0; i < kVerdicts; ++i) expect("verdict " + std::to_string(i));
  for (int i = 0; i < 5; ++i) expect("state " + std::to_string(i));
  for (std::size_t i = 0; i < kLossKinds; ++i) expect("kind " + std::to_string(i));
  for (int i = 0; i < 6; ++i) expect("end " + std::to_string(i));
  for (int i = 0; i < 3; ++i)
    for (const char* how : {" found", " vain"}) expect("search " + std::to_string(i) + how);
  for (const char* what : {"rule a", "rule b", "uncoded", "failed", "hold, no hit", "spurious", "ignored"})
    expect(what);
}

TEST(RandomTimelines, AreTheSameForTheSameSeed) {
  const Case once = random_case(7), again = random_case(7);
  EXPECT_EQ(once.recording.captured, again.recording.captured);
  ASSERT_EQ(once.trajectory.frames.size(), again.trajectory.frames.size());
  for (std::size_t k = 0; k < once.trajectory.frames.size(); ++k)
    EXPECT_EQ(once.trajectory.frames[k].sightings, again.trajectory.frames[k].sightings);
}

}  // namespace
}  // namespace relock
