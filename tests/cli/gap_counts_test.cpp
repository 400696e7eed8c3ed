#include "cli/reproduce/gap_counts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "cli/reproduce/gap_words.h"
#include "cli/reproduce/gaps_or_blur.h"
#include "tests/cli/made_comparison.h"

namespace relock::reproduction {
namespace {

/// What a method made of 30 frames a second, none missing: one letter a frame as in MadeRun.
GapCount counted(const std::string& letters) {
  const ScoredComparison runs = scored(made_comparison("flight", {{"blut", {letters}}}), Gate{});
  Cut all;
  for (std::size_t i = 0; i < letters.size(); ++i) all.frames.push_back(static_cast<FrameIndex>(i));
  all.captured = runs.stored.recording.captured;
  const auto counts = counts_of(runs, {}, all);
  EXPECT_EQ(counts.size(), 1u);
  return counts.front();
}

TEST(GapCounts, CountLossesAndTheTimeThatTheTargetIsHeld) {
  const GapCount count = counted(std::string(60, 'H') + std::string(30, 'S'));
  EXPECT_EQ(count.losses, 1u);
  EXPECT_EQ(count.recovered, 0u);
  // From the first Hit to the last: a state is in force from its frame to the next.
  EXPECT_NEAR(count.held_minutes, 59 / 30.0 / 60, 1e-6);
  EXPECT_NEAR(count.losses_per_minute(), 1 / count.held_minutes, 1e-9);
}

TEST(GapCounts, TellALossThatTheMethodEndsFromOneThatItDoesNot) {
  const GapCount count =
      counted(std::string(40, 'H') + std::string(20, 'S') + std::string(40, 'H') + std::string(20, 'S'));
  EXPECT_EQ(count.losses, 2u);
  EXPECT_EQ(count.recovered, 1u);
}

TEST(GapCounts, MeasureHeldTimeInTheFlightWhateverTheCutsClockSays) {
  const std::string letters = std::string(30, 'H');
  const ScoredComparison runs = scored(made_comparison("flight", {{"blut", {letters}}}), Gate{});
  Cut every_third;
  for (FrameIndex i = 0; i < 30; ++i) every_third.frames.push_back(3 * i);
  every_third.captured = runs.stored.recording.captured;
  EXPECT_NEAR(counts_of(runs, {}, every_third).front().held_minutes, 3 * counted(letters).held_minutes, 1e-9);
}

TEST(FlightMeans, HaveStudentsInterval) {
  const FlightMean mean = mean_of({1, 2, 3, 4, 5});
  EXPECT_DOUBLE_EQ(mean.value, 3);
  // 2.776 = t(0.975; 4), times the deviation sqrt(2.5) over sqrt(5).
  ASSERT_TRUE(mean.interval);
  EXPECT_NEAR(mean.interval->high - 3, 2.776445 * std::sqrt(0.5), 1e-5);
  EXPECT_NEAR(3 - mean.interval->low, 2.776445 * std::sqrt(0.5), 1e-5);
  EXPECT_FALSE(mean_of({1}).interval);
}

/// Rates of three flights that differ in how many losses they have anyhow, and what each factor adds to them.
LossRates made_rates(double jump, double pause, double blur, double jump_with_pause, double jump_with_blur) {
  LossRates rates;
  for (const GapArm arm : kGapArms)
    for (const bool blurred : {false, true})
      for (const double anyhow : {1.0, 4.0, 2.0}) {
        const double j = jumps(arm) ? 1 : 0, p = pauses(arm) ? 1 : 0, b = blurred ? 1 : 0;
        rates[static_cast<std::size_t>(arm)][blurred ? 1 : 0].push_back(
            anyhow + jump * j + pause * p + blur * b + jump_with_pause * j * p + jump_with_blur * j * b);
      }
  return rates;
}

TEST(GapEffects, AreWhatEachFactorAddsAndWhatFlightsHaveInCommonCancels) {
  const GapEffects effects = effects_of(made_rates(10, 3, -2, 0, 0));
  EXPECT_NEAR(effects.jump.value, 10, 1e-9);
  EXPECT_NEAR(effects.pause.value, 3, 1e-9);
  EXPECT_NEAR(effects.blur.value, -2, 1e-9);
  EXPECT_NEAR(effects.jump_with_pause.value, 0, 1e-9);
  EXPECT_NEAR(effects.jump_with_blur.value, 0, 1e-9);
  EXPECT_NEAR(effects.jump.interval->low, 10, 1e-9);
}

TEST(GapEffects, TellInteractionsFromMainEffects) {
  const GapEffects effects = effects_of(made_rates(10, 3, -2, 4, 6));
  EXPECT_NEAR(effects.jump_with_pause.value, 4, 1e-9);
  EXPECT_NEAR(effects.jump_with_blur.value, 6, 1e-9);
  EXPECT_NEAR(effects.jump.value, 10 + 4 / 2.0 + 6 / 2.0, 1e-9);
  EXPECT_NEAR(effects.pause.value, 3 + 4 / 2.0, 1e-9);
  EXPECT_NEAR(effects.blur.value, -2 + 6 / 2.0, 1e-9);
}

/// A step over `slots` slots, by `tenths` of D.
Transition step(int slots, double tenths, bool lost = false) {
  Transition made;
  made.recorded_slots = slots - 1.0;
  made.displacement = tenths;
  made.lost = lost;
  return made;
}

TEST(StepRisks, AreOfEveryStepWhoseDisplacementIsKnownInOneBinOnly) {
  std::vector<Transition> steps{step(1, 0), step(1, 2.4), step(1, 2.5, true), step(2, 9.9, true),
                                step(4, 50)};
  steps.emplace_back();
  const auto bins = risk_by_displacement(steps, {0, 0.25, 0.5, 1});
  ASSERT_EQ(bins.size(), 4u);
  EXPECT_EQ(bins[0].steps, 2u);
  EXPECT_EQ(bins[1].steps, 1u);
  EXPECT_EQ(bins[1].lost, 1u);
  EXPECT_EQ(bins[2].steps, 1u);
  EXPECT_EQ(bins[3].steps, 1u);
  EXPECT_EQ(bins[3].lost, 0u);
}

TEST(LossesNearGaps, AreOverAGapOfMoreThanATenthOfASecondOrOneOfTheTwoStepsAfter) {
  const NearGap near = near_gaps(
      {step(1, 0), step(3, 0, true), step(4, 0), step(1, 0, true), step(1, 0, true), step(1, 0, true)},
      period_of(30));
  EXPECT_EQ(near.all.steps, 6u);
  EXPECT_EQ(near.all.lost, 4u);
  EXPECT_EQ(near.near.steps, 3u);
  EXPECT_EQ(near.near.lost, 2u);
}

/// Counts of three flights in every cell, of rates that are known.
GapCounts made_counts(const LossRates& rates) {
  GapCounts counts;
  counts.period = period_of(30);
  for (const GapArm arm : kGapArms)
    for (const bool blurred : {false, true})
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        GapCount count{.method = "blut", .cell = {arm, blurred, seed}};
        count.frames = 100;
        count.losses = static_cast<std::size_t>(
            std::lround(100 * rates[static_cast<std::size_t>(arm)][blurred ? 1 : 0][seed - 1]));
        count.held_minutes = 100;
        counts.reset.push_back(count);
        if (!blurred || !jumps(arm)) continue;
        count.answers = {Vec2{1, 2}, {}, Vec2{static_cast<double>(seed), 2}};
        counts.once.push_back(count);
      }
  return counts;
}

std::string said(const GapCounts& counts) {
  std::string all;
  for (const std::string& sentence : finding_of_gaps(counts).sentences) all += sentence + "\n";
  return all;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(TheSentencesOnGaps, NameTheCauseThatTheCountsTell) {
  EXPECT_TRUE(contains(said(made_counts(made_rates(10, 0, 0, 0, 0))), "It is the jump over a gap"));
  EXPECT_TRUE(contains(said(made_counts(made_rates(0, 10, 0, 0, 0))), "It is the time that passes"));
  EXPECT_TRUE(
      contains(said(made_counts(made_rates(10, 10, 0, 0, 0))), "Both the jump over a gap and the time"));
  EXPECT_TRUE(
      contains(said(made_counts(made_rates(0, 0, 5, 0, 0))), "Neither the jump over a gap nor its time"));
}

TEST(TheSentencesOnGaps, SayThatATrackerLooksAtNoClockOnlyWhenItsAnswersAreTheSame) {
  GapCounts counts = made_counts(made_rates(10, 0, 0, 0, 0));
  EXPECT_TRUE(contains(said(counts),
                       "3 of 3 flights the same whether time passes in the gaps or not: it looks at no "
                       "clock."));
  counts.once.back().answers[1] = Vec2{5, 5};
  EXPECT_TRUE(contains(said(counts), "2 of 3 flights the same"));
  EXPECT_FALSE(contains(said(counts), "it looks at no clock"));
}

}  // namespace
}  // namespace relock::reproduction
