#include "core/time.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace relock {
namespace {

std::vector<Time> times(std::initializer_list<std::int64_t> milliseconds) {
  std::vector<Time> all;
  for (const auto ms : milliseconds) all.push_back(time_ns(ms * 1'000'000));
  return all;
}
constexpr Duration ms(std::int64_t n) { return std::chrono::milliseconds(n); }

TEST(NominalPeriod, IsThePeriodOfASteadyCamera) { EXPECT_EQ(nominal_period(times({0, 33, 66, 99})), ms(33)); }

TEST(NominalPeriod, IsNotMovedByBurstyDropsThatMoveTheMedian) {
  const auto captured = times({0, 30, 60, 150, 240, 330, 420, 510, 600});
  EXPECT_EQ(nominal_period(captured), ms(30));
  EXPECT_EQ(median_interval(captured), ms(90));
}

TEST(NominalPeriod, IsTheSameWhenTheEpochMoves) {
  auto captured = times({0, 31, 66, 99, 190, 223});
  const Duration period = nominal_period(captured);
  for (Time& time : captured) time += std::chrono::hours(100);
  EXPECT_EQ(nominal_period(captured), period);
}

TEST(NominalPeriod, NeedsTwoTimes) { EXPECT_THROW(nominal_period(times({0})), Error); }

TEST(Slots, AreRoundedToTheNearestAndAtLeastOne) {
  EXPECT_EQ(slots(ms(1), ms(30)), 1);
  EXPECT_EQ(slots(ms(44), ms(30)), 1);
  EXPECT_EQ(slots(ms(45), ms(30)), 2);
  EXPECT_EQ(slots(ms(90), ms(30)), 3);
}

TEST(Slots, OfThreeFramesAt30HzAreThreeOnEitherSideOfTheKnifeEdge) {
  const Duration period = period_of(30);
  EXPECT_EQ(slots(Duration(99'999'000), period), 3);
  EXPECT_EQ(slots(Duration(100'001'000), period), 3);
}

}  // namespace
}  // namespace relock
