#include "eval/statistics/interval.h"

#include <gtest/gtest.h>

#include <cmath>

namespace relock {
namespace {

TEST(Wilson, AgreesWithTheTableOfNewcombe1998) {
  // Newcombe, Statistics in Medicine 17 (1998) 857, table I, method 3.
  const Interval many = wilson(81, 263);
  EXPECT_NEAR(many.low, 0.2553, 5e-5);
  EXPECT_NEAR(many.high, 0.3662, 5e-5);
  const Interval none = wilson(0, 20);
  EXPECT_DOUBLE_EQ(none.low, 0);
  EXPECT_NEAR(none.high, 0.1611, 5e-5);
  EXPECT_NEAR(wilson(1, 29).high, 0.1718, 5e-5);
}

TEST(Wilson, KnowsNothingWithoutATrial) { EXPECT_EQ(wilson(0, 0), (Interval{0, 1})); }

TEST(PoissonRate, HoldsTheRatesUnderWhichSoFewOrSoManyEventsAreNotRare) {
  for (const std::size_t events : {0u, 1u, 4u, 30u}) {
    const Interval rate = poisson_rate(events, 1);
    double fewer_or_as_many = 0, fewer = 0, term = std::exp(-rate.high), low_term = std::exp(-rate.low);
    for (std::size_t k = 0; k <= events; ++k) {
      fewer_or_as_many += term;
      if (k < events) fewer += low_term;
      term *= rate.high / static_cast<double>(k + 1);
      low_term *= rate.low / static_cast<double>(k + 1);
    }
    EXPECT_NEAR(fewer_or_as_many, 0.025, 1e-9) << events;
    if (events > 0) {
      EXPECT_NEAR(1 - fewer, 0.025, 1e-9) << events;
    } else {
      EXPECT_EQ(rate.low, 0);
    }
  }
}

TEST(PoissonRate, IsPerUnitOfExposure) {
  EXPECT_DOUBLE_EQ(poisson_rate(7, 4).high, poisson_rate(7, 1).high / 4);
  EXPECT_TRUE(std::isinf(poisson_rate(0, 0).high));
}

}  // namespace
}  // namespace relock
