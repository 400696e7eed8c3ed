#include "eval/statistics/kaplan_meier.h"

#include <gtest/gtest.h>

#include <cmath>

namespace relock {
namespace {

// Remission of leukaemia under 6-mercaptopurine, weeks: Freireich et al., Blood 21 (1963); the product-limit
// estimate is worked out in many textbooks.
const std::vector<Lifetime> kFreireich{
    {6, true},   {6, true},   {6, true},   {6, false},  {7, true},   {9, false},  {10, true},
    {10, false}, {11, false}, {13, true},  {16, true},  {17, false}, {19, false}, {20, false},
    {22, true},  {23, true},  {25, false}, {32, false}, {32, false}, {34, false}, {35, false}};

TEST(KaplanMeier, AgreesWithTheWorkedExampleOfFreireich1963) {
  const KaplanMeier estimate(kFreireich);
  EXPECT_NEAR(estimate.survival(6), 0.857, 5e-4);
  EXPECT_NEAR(estimate.survival(7), 0.807, 5e-4);
  EXPECT_NEAR(estimate.survival(10), 0.753, 5e-4);
  EXPECT_NEAR(estimate.survival(13), 0.690, 5e-4);
  EXPECT_NEAR(estimate.survival(16), 0.627, 5e-4);
  EXPECT_NEAR(estimate.survival(22), 0.538, 5e-4);
  EXPECT_NEAR(estimate.survival(23), 0.448, 5e-4);
  EXPECT_EQ(estimate.time_until(0.5), 23);
  EXPECT_EQ(estimate.time_until(0.1), std::nullopt);
  EXPECT_EQ(estimate.probability_by(36), std::nullopt) << "past the follow-up";
}

TEST(KaplanMeier, HasTheLimitsThatRPrintsForThatExample) {
  // survfit(Surv(time, event) ~ 1, conf.type = "log-log") of R 4.2.2, survival 3.5-3.
  struct Row {
    double time, low, high;
  };
  const KaplanMeier estimate(kFreireich);
  for (const Row& row :
       {Row{6, 0.6197, 0.9516}, Row{7, 0.5631, 0.9228}, Row{10, 0.5032, 0.8894}, Row{13, 0.4316, 0.8491},
        Row{16, 0.3675, 0.8049}, Row{22, 0.2678, 0.7468}, Row{23, 0.1881, 0.6801}}) {
    const auto interval = estimate.survival_interval(row.time);
    ASSERT_TRUE(interval) << row.time;
    EXPECT_NEAR(interval->low, row.low, 5e-5) << row.time;
    EXPECT_NEAR(interval->high, row.high, 5e-5) << row.time;
  }
  EXPECT_EQ(estimate.survival_interval(5), std::nullopt) << "nothing has happened";
  const auto median = estimate.time_until_interval(0.5);
  ASSERT_TRUE(median);
  EXPECT_EQ(median->low, 13);
  EXPECT_TRUE(std::isinf(median->high));
}

TEST(KaplanMeier, IsTheShareItselfWhenNothingIsCensored) {
  const KaplanMeier estimate(std::vector<Lifetime>{{1, true}, {2, true}, {3, true}, {4, true}});
  EXPECT_DOUBLE_EQ(estimate.survival(2.5), 0.5);
  EXPECT_EQ(estimate.time_until(0.5), 2);
  EXPECT_EQ(estimate.probability_by(100), 1) << "none is left";
}

TEST(KaplanMeier, KnowsNothingWithoutALoss) {
  const KaplanMeier estimate({});
  EXPECT_EQ(estimate.time_until(0.5), std::nullopt);
  EXPECT_EQ(estimate.time_until_interval(0.5), std::nullopt);
  EXPECT_EQ(estimate.probability_by(1), std::nullopt);
}

}  // namespace
}  // namespace relock
