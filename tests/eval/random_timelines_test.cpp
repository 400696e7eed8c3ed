#include "tests/eval/random_timelines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <optional>
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

// Into what each score falls: n/a, 0, in between, 1 (of shares) and infinite.
void tell(std::map<std::string, int>& count, const std::string& score, const std::optional<double>& value) {
  const char* what = !value               ? " n/a"
                     : *value == 0        ? " 0"
                     : std::isinf(*value) ? " infinite"
                     : *value == 1        ? " 1"
                                          : " else";
  ++count[score + what];
}

void tell(std::map<std::string, int>& count, const Scores& s) {
  tell(count, "f1", s.f1);
  tell(count, "wrong identity rate", s.wrong_identity_rate);
  tell(count, "false alarms", s.false_alarms_per_1000);
  tell(count, "spurious", s.spurious_per_minute);
  tell(count, "median age", s.fix_age.median_s);
  tell(count, "p95 age", s.fix_age.p95_s);
  tell(count, "oldest age", s.fix_age.max_s);
  tell(count, "silent share", s.silent_share);
}

template <std::size_t n>
void tell(std::map<std::string, int>& count, const std::string& bin, const std::array<HitCount, n>& bins) {
  for (std::size_t i = 0; i < n; ++i) {
    count[bin + std::to_string(i) + " hit"] += static_cast<int>(bins[i].hits);
    count[bin + std::to_string(i) + " not hit"] += static_cast<int>(bins[i].could_hit - bins[i].hits);
  }
}

std::map<std::string, int> score_occurrences() {
  std::map<std::string, int> count;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const auto [recording, trajectory] = random_case(seed);
    const ScoreSheet sheet =
        naive::score(recording, trajectory, naive::evaluate(recording, trajectory, Gate{}));
    tell(count, sheet.pooled);
    for (const Scores& target : sheet.targets) tell(count, target);
    tell(count, "blur ", sheet.pooled.by_blur);
    tell(count, "gap ", sheet.pooled.by_gap);
  }
  return count;
}

TEST(RandomTimelines, MakeEveryScoreNothingAndMuchAndNotAvailableOften) {
  const auto count = score_occurrences();
  for (const auto& [what, times] : count) RecordProperty(what, times);
  const auto expect = [&](const std::string& what) {
    const auto found = count.find(what);
    EXPECT_GE(found == count.end() ? 0 : found->second, kOften) << what;
  };
  for (const char* score : {"f1", "wrong identity rate", "false alarms", "silent share"})
    for (const char* what : {" n/a", " 0", " else"}) expect(score + std::string(what));
  for (const char* what : {"silent share 1", "spurious 0", "spurious else"}) expect(what);
  for (const char* age : {"median age", "p95 age", "oldest age"})
    for (const char* what : {" n/a", " else", " infinite"}) expect(age + std::string(what));
  for (std::size_t i = 0; i < kBlurBinCount; ++i)
    for (const char* what : {" hit", " not hit"}) expect("blur " + std::to_string(i) + what);
  for (std::size_t i = 0; i < kGapBinCount; ++i)
    for (const char* what : {" hit", " not hit"}) expect("gap " + std::to_string(i) + what);
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
