#include "eval/statistics/ratio.h"

#include <gtest/gtest.h>

#include "tests/eval/statistics/outages.h"

namespace relock {
namespace {

constexpr std::uint64_t kRepetitions = 600;

#define EXPECT_COVERS(coverage)                                           \
  EXPECT_GE((coverage).percent(), 93) << (coverage).told << " were told"; \
  EXPECT_LE((coverage).percent(), 97) << (coverage).told << " were told"; \
  EXPECT_GE((coverage).told, (coverage).asked * 9 / 10)

Coverage coverage_of_share(std::size_t runs, std::size_t frames, const Outages& outages) {
  Coverage coverage;
  for (std::uint64_t seed = 0; seed < kRepetitions; ++seed) {
    Random random(seed);
    std::vector<RatioSeries> sequences;
    for (std::size_t run = 0; run < runs; ++run)
      sequences.push_back(share_of_frames(simulate_outages(random, frames, outages)));
    coverage.add(ratio_interval(sequences), outages.truth());
  }
  return coverage;
}

TEST(RatioInterval, CoversInOneRunOfAThousandFrames) {
  EXPECT_COVERS(coverage_of_share(1, 1000, {0.2, 5, 30}));
  EXPECT_COVERS(coverage_of_share(1, 1000, {0.4, 5, 30}));
  EXPECT_COVERS(coverage_of_share(1, 1000, {0.1, 5, 0}));
}

TEST(RatioInterval, CoversWhenOutagesHaveManyLengthsAndSingleFramesFlicker) {
  EXPECT_COVERS(coverage_of_share(1, 1000, {0.2, 15, 0}));
  EXPECT_COVERS(coverage_of_share(1, 1000, {0.2, 5, 30, 0.1}));
}

TEST(RatioInterval, CoversInAFewRuns) { EXPECT_COVERS(coverage_of_share(3, 1000, {0.1, 5, 30})); }

TEST(RatioInterval, CoversOverManySequences) { EXPECT_COVERS(coverage_of_share(12, 300, {0.1, 5, 30})); }

TEST(DifferenceInterval, CoversOfTwoMethodsThatShareOutagesAndHaveTheirOwn) {
  for (const std::size_t runs : {1u, 12u}) {
    Coverage coverage;
    for (std::uint64_t seed = 0; seed < kRepetitions; ++seed) {
      Random random(seed);
      std::vector<RatioSeries> a, b;
      for (std::size_t run = 0; run < runs; ++run) {
        auto shared = simulate_outages(random, 1000, {0.2, 5, 30}), other = shared;
        const auto of_a = simulate_outages(random, 1000, {0.1, 5, 30});
        const auto of_b = simulate_outages(random, 1000, {0.2, 5, 30});
        for (std::size_t i = 0; i < shared.size(); ++i) {
          other[i] *= of_b[i];
          shared[i] *= of_a[i];
        }
        a.push_back(share_of_frames(shared));
        b.push_back(share_of_frames(other));
      }
      coverage.add(difference_interval(a, b), 0.8 * 0.9 - 0.8 * 0.8);
    }
    EXPECT_COVERS(coverage) << runs << " runs";
  }
}

/// Time with a success at most three frames old, as availability counts it, on frames of unequal length.
RatioSeries available(const std::vector<double>& good) {
  RatioSeries series;
  int age = 3;
  for (std::size_t i = 0; i < good.size(); ++i) {
    age = good[i] > 0 ? 0 : age + 1;
    const double time = i % 7 == 0 ? 2 : 1;
    series.part.push_back(age < 3 ? time : 0);
    series.whole.push_back(time);
  }
  return series;
}

TEST(RatioInterval, CoversAnAvailability) {
  const Outages outages{0.2, 5, 30, 0.2};
  Random endless(1);
  const RatioSeries all = available(simulate_outages(endless, 1000000, outages));
  double part = 0, whole = 0;
  for (std::size_t i = 0; i < all.part.size(); ++i) part += all.part[i], whole += all.whole[i];
  Coverage coverage;
  for (std::uint64_t seed = 2; seed < kRepetitions + 2; ++seed) {
    Random random(seed);
    const std::vector<RatioSeries> run{available(simulate_outages(random, 1000, outages))};
    coverage.add(ratio_interval(run), part / whole);
  }
  EXPECT_COVERS(coverage);
}

std::vector<FramedValue> framed(const std::vector<double>& values) {
  std::vector<FramedValue> all;
  for (std::size_t k = 0; k < values.size(); ++k) all.push_back({k, values[k]});
  return all;
}

TEST(QuantileInterval, IsNotNarrowedByCopiesOfTheSameFrames) {
  Random random(3);
  std::vector<double> errors;
  double wander = random.normal();
  for (int i = 0; i < 1000; ++i) errors.push_back(std::exp(wander = 0.9 * wander + 0.4 * random.normal()));
  std::vector<FramedValue> once = framed(errors), thrice = once;
  for (int copy = 0; copy < 2; ++copy) thrice.insert(thrice.end(), once.begin(), once.end());
  const auto one = quantile_interval(std::vector<std::vector<FramedValue>>{once}, 0.5),
             three = quantile_interval(std::vector<std::vector<FramedValue>>{thrice}, 0.5);
  ASSERT_TRUE(one && three);
  EXPECT_NEAR(three->low, one->low, 0.01 * one->low);
  EXPECT_NEAR(three->high, one->high, 0.01 * one->high);
}

TEST(QuantileInterval, CoversTheMedianOfErrorsThatWander) {
  Coverage coverage;
  for (std::uint64_t seed = 0; seed < kRepetitions; ++seed) {
    Random random(seed);
    std::vector<double> errors;
    double wander = random.normal();
    for (int i = 0; i < 1000; ++i) {
      wander = 0.9 * wander + std::sqrt(1 - 0.81) * random.normal();
      errors.push_back(std::exp(wander));
    }
    coverage.add(quantile_interval(std::vector<std::vector<FramedValue>>{framed(errors)}, 0.5), 1);
  }
  EXPECT_COVERS(coverage);
}

TEST(RatioInterval, IsNothingWhereTooLittleHappened) {
  const auto told = [](const std::string& frames) {
    RatioSeries series;
    for (const char c : frames) series.part.push_back(c == 'H' ? 1 : 0), series.whole.push_back(1);
    return ratio_interval(std::vector<RatioSeries>{series}).has_value();
  };
  const std::string good(100, 'H'), bad(5, 'M');
  EXPECT_FALSE(told(good)) << "nobody knows how long an outage would be";
  EXPECT_FALSE(told(good + bad + good + bad + good)) << "two outages";
  EXPECT_TRUE(told(good + bad + good + bad + good + bad + good + bad + good + bad + good + bad + good));
  EXPECT_EQ(ratio_interval(std::vector<RatioSeries>{{{0, 0}, {0, 0}}}), std::nullopt);
  EXPECT_EQ(ratio_interval({}), std::nullopt);
}

TEST(RatioInterval, OfSequencesNeedsTheirTotalsOnly) {
  Random random(3);
  std::vector<RatioSeries> frames, totals;
  for (int i = 0; i < 12; ++i) {
    frames.push_back(share_of_frames(simulate_outages(random, 400, {})));
    double part = 0;
    for (const double v : frames.back().part) part += v;
    totals.push_back({{part}, {400}});
  }
  const auto of_frames = ratio_interval(frames), of_totals = ratio_interval(totals);
  ASSERT_TRUE(of_frames && of_totals);
  EXPECT_NEAR(of_frames->low, of_totals->low, 1e-12);
  EXPECT_NEAR(of_frames->high, of_totals->high, 1e-12);
}

TEST(DifferenceInterval, TurnsItsSignWithTheOrder) {
  Random random(4);
  const std::vector<RatioSeries> a{share_of_frames(simulate_outages(random, 1000, {}))};
  const std::vector<RatioSeries> b{share_of_frames(simulate_outages(random, 1000, {}))};
  const auto one = difference_interval(a, b), other = difference_interval(b, a);
  ASSERT_TRUE(one && other);
  EXPECT_NEAR(one->low, -other->high, 1e-12);
  EXPECT_NEAR(one->high, -other->low, 1e-12);
  EXPECT_EQ(difference_interval(a, a), std::nullopt) << "they never differ";
}

}  // namespace
}  // namespace relock
