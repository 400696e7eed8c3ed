#include "eval/survival.h"

#include <gtest/gtest.h>

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

TEST(KaplanMeier, IsTheShareItselfWhenNothingIsCensored) {
  const KaplanMeier estimate(std::vector<Lifetime>{{1, true}, {2, true}, {3, true}, {4, true}});
  EXPECT_DOUBLE_EQ(estimate.survival(2.5), 0.5);
  EXPECT_EQ(estimate.time_until(0.5), 2);
  EXPECT_EQ(estimate.probability_by(100), 1) << "none is left";
}

TEST(KaplanMeier, KnowsNothingWithoutALoss) {
  const KaplanMeier estimate({});
  EXPECT_EQ(estimate.time_until(0.5), std::nullopt);
  EXPECT_EQ(estimate.probability_by(1), std::nullopt);
}

}  // namespace
}  // namespace relock
