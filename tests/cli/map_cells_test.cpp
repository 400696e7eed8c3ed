#include "cli/map/cells.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "tests/cli/synthetic_map.h"

namespace relock::maps {
namespace {

bool holds(const Interval& interval, double value) { return interval.low <= value && value <= interval.high; }

Estimate votes(std::vector<double> values) {
  LockedTime time;
  for (const double value : values) time.locked_s.push_back(value), time.visible_s.push_back(1);
  return locked_share(time);
}

TEST(LockedShare, OfFlightsOfOneLengthIsTheMeanWithStudentsInterval) {
  const Estimate share = votes({0.2, 0.4, 0.6});
  EXPECT_NEAR(share.value.value(), 0.4, 1e-12);
  // Deviation 0.2, error 0.2 / sqrt(3), and 4.302652729749464 is Student's t for two degrees of freedom.
  EXPECT_NEAR(share.interval().low, 0.4 - 4.302652729749464 * 0.2 / std::sqrt(3), 1e-9);
  EXPECT_NEAR(share.interval().high, 0.4 + 4.302652729749464 * 0.2 / std::sqrt(3), 1e-9);
}

TEST(LockedShare, WeighsLongFlightsMore) {
  EXPECT_DOUBLE_EQ(locked_share({{1, 9}, {10, 10}}).value.value(), 0.5);
  EXPECT_DOUBLE_EQ(locked_share({{1, 27}, {10, 30}}).value.value(), 0.7);
}

TEST(LockedShare, WithoutVisibleTimeIsNothing) {
  const Estimate nothing = locked_share({{0, 0}, {0, 0}});
  EXPECT_FALSE(nothing.value);
  EXPECT_FALSE(difference(nothing, votes({0.2, 0.4})).value);
  EXPECT_EQ(ahead(difference(nothing, votes({0.2, 0.4}))), Ahead::undecided);
}

TEST(LockedShare, IsWhatItWasWhenASeedWithoutVisibleTimeIsAdded) {
  const Estimate two = locked_share({{2, 6}, {10, 10}}), three = locked_share({{2, 0, 6}, {10, 0, 10}});
  EXPECT_DOUBLE_EQ(three.value.value(), two.value.value());
  EXPECT_DOUBLE_EQ(three.interval().low, two.interval().low);
  EXPECT_DOUBLE_EQ(three.interval().high, two.interval().high);
  EXPECT_TRUE(holds(locked_share({{2, 0}, {10, 0}}).interval(), 1e6)) << "one seed alone decides nothing";
}

TEST(LockedShare, OfOneSeedIsUndecided) {
  EXPECT_TRUE(holds(votes({1}).interval(), 1e6));
  EXPECT_EQ(ahead(difference(votes({1}), votes({0}))), Ahead::undecided);
}

TEST(LockedShare, IntervalsHoldTheTruthInNineteenOfTwentyExperiments) {
  for (const int seeds : {3, 5, 12}) {
    Random random(static_cast<std::uint64_t>(seeds));
    int held = 0;
    constexpr int kExperiments = 4000;
    for (int i = 0; i < kExperiments; ++i) {
      std::vector<double> values;
      for (int seed = 0; seed < seeds; ++seed) values.push_back(0.6 + 0.1 * random.normal());
      held += holds(votes(values).interval(), 0.6);
    }
    EXPECT_NEAR(static_cast<double>(held) / kExperiments, 0.95, 0.015) << seeds << " seeds";
  }
}

TEST(Difference, ArePairedSoThatWhatBothShareCancels) {
  const Estimate a = votes({0.2, 0.5, 0.9}), b = votes({0.1, 0.4, 0.8});
  EXPECT_EQ(ahead(difference(a, b)), Ahead::tracking);
  EXPECT_EQ(ahead(difference(b, a)), Ahead::detection);
  EXPECT_NEAR(difference(a, b).interval().low, 0.1, 1e-9);
}

TEST(Difference, IsUndecidedWhereSeedsDisagree) {
  EXPECT_EQ(ahead(difference(votes({0.9, 0.2, 0.8}), votes({0.5, 0.5, 0.5}))), Ahead::undecided);
}

TEST(Difference, OfTwoThatNeverHaveTheTargetIsUndecided) {
  EXPECT_EQ(ahead(difference(votes({0, 0, 0}), votes({0, 0, 0}))), Ahead::undecided);
}

TEST(BestOfAMap, IsTheHighestOfItsClassOverAllCells) {
  const MeasuredMap map = known_map(0, 1);
  auto methods = map.methods;
  methods.push_back(known_method(
      "best", MethodClass::tracker, map.plan, [](auto...) { return 0.97; }, 0, 1));
  methods.push_back(known_method(
      "oracle", MethodClass::yardstick, map.plan, [](auto...) { return 1.0; }, 0, 1));
  EXPECT_EQ(best_of(methods, MethodClass::tracker)->name, "best");
  EXPECT_EQ(best_of(methods, MethodClass::detector)->name, "find");
  EXPECT_EQ(best_of({}, MethodClass::detector), nullptr);
}

}  // namespace
}  // namespace relock::maps
