#include "eval/scores/attribution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "core/random.h"

namespace relock {
namespace {

/// What the odds of a loss are made of, for each unit.
struct World {
  double base = -4, slot = 0.8, blur = 0.3;  ///< log odds
};

Transition draw(Random& random, const World& world) {
  Transition t;
  for (int i = 0; i < 3; ++i) t.injected_slots += random.chance(0.1) ? 1 : 0;
  t.blur = 4 * random.uniform();
  const double log_odds = world.base + world.slot * t.injected_slots + world.blur * *t.blur;
  t.lost = random.chance(1 / (1 + std::exp(-log_odds)));
  return t;
}

std::vector<TransitionRun> draw_runs(std::uint64_t seed, std::size_t runs, int each,
                                     const World& world = {}) {
  Random random(seed);
  std::vector<TransitionRun> drawn(runs);
  for (std::size_t i = 0; i < runs; ++i) {
    drawn[i].sequence = i;
    for (int n = 0; n < each; ++n) drawn[i].transitions.push_back(draw(random, world));
  }
  return drawn;
}

/// How often the interval of the effect of a slot holds the truth, in percent.
double coverage(std::size_t runs, int each, int repetitions) {
  int covered = 0;
  for (int i = 0; i < repetitions; ++i) {
    const Attribution found = attribute(draw_runs(static_cast<std::uint64_t>(i), runs, each), Gaps::injected);
    const Interval interval = found.effects.at(0).interval.value();
    const double truth = std::exp(World{}.slot);
    covered += interval.low <= truth && truth <= interval.high ? 1 : 0;
  }
  return 100.0 * covered / repetitions;
}

TEST(Attribution, CoversTheTrueEffectOverManySequences) {
  const double percent = coverage(20, 100, 200);
  EXPECT_GE(percent, 92);
  EXPECT_LE(percent, 98);
}

TEST(Attribution, CoversTheTrueEffectInOneRun) {
  const double percent = coverage(1, 500, 40);
  EXPECT_GE(percent, 90);
  EXPECT_LE(percent, 99);
}

TEST(Attribution, TellsCausesOnlyOfWhatWasInjected) {
  const auto runs = draw_runs(7, 12, 300);
  const Attribution found = attribute(runs, Gaps::injected);
  ASSERT_EQ(found.effects.size(), 2u);
  EXPECT_EQ(found.effects[0].covariate, Effect::Covariate::injected_slots);
  EXPECT_TRUE(found.effects[0].because);
  EXPECT_EQ(found.effects[1].covariate, Effect::Covariate::blur);
  EXPECT_FALSE(found.effects[1].because);
  EXPECT_NE(sentence(found.effects[0]).find("multiplies the odds of a loss"), std::string::npos);
  EXPECT_NE(sentence(found.effects[1]).find("goes with"), std::string::npos);
  for (const Effect& effect : attribute(runs, Gaps::recorded).effects) EXPECT_FALSE(effect.because);
}

TEST(Attribution, FindsNothingInGapsThatDoNothing) {
  const Attribution found = attribute(draw_runs(8, 12, 300, {-3, 0, 0.3}), Gaps::injected);
  const Interval interval = found.effects.at(0).interval.value();
  EXPECT_LT(interval.low, 1);
  EXPECT_GT(interval.high, 1);
}

TEST(Attribution, IsNotToldOfTooFewLosses) {
  const Attribution found = attribute(draw_runs(9, 3, 200, {-8, 0, 0}), Gaps::injected);
  EXPECT_LT(found.losses, kLeastLosses);
  EXPECT_EQ(found.too_few, TooFew::losses);
  EXPECT_TRUE(found.effects.empty());
}

TEST(Attribution, IsNotToldWhereNothingVaries) {
  auto runs = draw_runs(10, 3, 400, {-2, 0, 0});
  for (TransitionRun& run : runs)
    for (Transition& t : run.transitions) t.injected_slots = 0, t.blur.reset();
  EXPECT_EQ(attribute(runs, Gaps::injected).too_few, TooFew::variation);
}

TEST(Attribution, OfALossWithEveryGapIsStillANumber) {
  auto runs = draw_runs(11, 2, 500);
  for (TransitionRun& run : runs)
    for (Transition& t : run.transitions) t.lost = t.injected_slots >= 1;
  const Attribution found = attribute(runs, Gaps::injected);
  EXPECT_TRUE(std::isfinite(found.effects.at(0).odds_ratio));
  EXPECT_GT(found.effects.at(0).odds_ratio, 10);
}

/// One target that moves 4 px a frame at D = 40, at 30 Hz; . is a frame that was dropped, b one for which
/// it was busy.
struct Told {
  Recording recording;
  Trajectory trajectory;
};
Told told(const std::string& letters) {
  Told t;
  t.recording.name = "line";
  t.recording.picture = {640, 480};
  t.recording.period = std::chrono::milliseconds(33);
  t.recording.targets = {Target{"a"}};
  t.trajectory.judged_from = {0};
  t.trajectory.failed_from = {std::nullopt};
  for (std::size_t i = 0; i < letters.size(); ++i) {
    const Box box{20.0 + 4.0 * static_cast<double>(i), 100, 40, 40};
    t.recording.captured.push_back(Time{static_cast<std::int64_t>(i) * t.recording.period});
    TargetTruth truth;
    truth.label = Label::visible;
    truth.outline = box;
    truth.blur = BlurVector{8, 0};
    t.recording.truth.push_back(truth);
    FrameReport report;
    if (letters[i] == '.') report.delivery = Delivery::dropped;
    if (letters[i] == 'b') report.delivery = Delivery::skipped;
    if (letters[i] == 'g') report.given = {0};
    if (letters[i] == 'H' || letters[i] == 'g') {
      Sighting sighting;
      sighting.centre = centre_of(Outline{box});
      sighting.outline = box;
      sighting.track = "a";
      report.sightings = {sighting};
    }
    t.trajectory.frames.push_back(report);
  }
  return t;
}

TEST(Transitions, AreOfLockedScoredDeliveredFramesInARowAndOneHasTheOnset) {
  const Told t = told("gHH..HHMMMMM");
  const Evaluation evaluation = evaluate(t.recording, t.trajectory);
  const auto found = transitions(t.recording, t.trajectory, 0, evaluation.targets[0]);
  ASSERT_EQ(found.size(), 4u)
      << "H-H, H..H, H-H, H-M; the Given is no scored frame, after the onset none is locked";
  EXPECT_EQ(found[1].injected_slots, 2);
  EXPECT_EQ(found[1].recorded_slots, 0);
  EXPECT_EQ(found[1].skipped_slots, 0);
  EXPECT_NEAR(found[1].displacement.value(), 3, 1e-9);
  EXPECT_NEAR(found[0].displacement.value(), 1, 1e-9);
  EXPECT_NEAR(found[0].blur.value(), 2, 1e-9);
  EXPECT_FALSE(found[0].lost || found[1].lost || found[2].lost);
  EXPECT_TRUE(found[3].lost);
}

TEST(Transitions, TellWhetherFramesNeverCameOrWereSkipped) {
  const Told t = told("gHHbbHHH");
  const auto found =
      transitions(t.recording, t.trajectory, 0, evaluate(t.recording, t.trajectory).targets[0]);
  ASSERT_EQ(found.size(), 4u);
  EXPECT_EQ(found[1].skipped_slots, 2);
  EXPECT_EQ(found[1].recorded_slots, 0);
  EXPECT_EQ(found[1].injected_slots, 0);
}

TEST(Attribution, DoesNotTakeABusyMethodForAGapInTheRecording) {
  auto runs = draw_runs(12, 12, 300);
  for (TransitionRun& run : runs)
    for (Transition& t : run.transitions) t.skipped_slots = std::exchange(t.injected_slots, 0.0);
  const Attribution found = attribute(runs, Gaps::recorded);
  ASSERT_EQ(found.effects.size(), 2u);
  EXPECT_EQ(found.effects[0].covariate, Effect::Covariate::skipped_slots);
  EXPECT_NE(sentence(found.effects[0]).find("each extra slot that the method was busy goes with odds"),
            std::string::npos)
      << sentence(found.effects[0]);
}

TEST(Attribution, TellsNoEffectOfAFitThatDidNotConverge) {
  const Attribution found = attribute(draw_runs(13, 12, 300), Gaps::injected, {1, 1e-18});
  EXPECT_EQ(found.too_few, TooFew::not_converged);
  EXPECT_TRUE(found.effects.empty());
  EXPECT_NE(sentence(found).find("the fit did not converge"), std::string::npos) << sentence(found);
}

}  // namespace
}  // namespace relock
