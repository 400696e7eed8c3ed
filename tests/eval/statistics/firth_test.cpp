#include "eval/statistics/firth.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"

namespace relock {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Data {
  MatrixXd x;
  VectorXd y;
};

/// Twenty rows; every row whose last column is 1 has an event, so that plain likelihood has no maximum.
Data separated() {
  const double x1[] = {0.2, 1.1, 0.7, 2.4, 1.9, 3.1, 0.4, 2.2, 1.5, 2.8,
                       0.9, 1.7, 2.6, 0.1, 3.4, 1.2, 2.0, 0.6, 2.9, 1.4};
  const int x2[] = {0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0};
  const int y[] = {0, 0, 1, 1, 1, 1, 0, 0, 1, 1, 0, 0, 1, 0, 1, 1, 1, 0, 0, 0};
  Data data{MatrixXd::Ones(20, 3), VectorXd(20)};
  for (int i = 0; i < 20; ++i) {
    data.x(i, 1) = x1[i];
    data.x(i, 2) = x2[i];
    data.y[i] = y[i];
  }
  return data;
}

TEST(Firth, AgreesWithBrglm2) {
  // R 4.2.2, brglm2 0.9: glm(y ~ x1 + x2, binomial, method = "brglmFit", type = "AS_mean").
  const Data data = separated();
  const auto fit = firth(data.x, data.y);
  ASSERT_TRUE(fit && fit->converged);
  EXPECT_NEAR(fit->coefficients[0], -2.237154677, 1e-7);
  EXPECT_NEAR(fit->coefficients[1], 1.094503102, 1e-7);
  EXPECT_NEAR(fit->coefficients[2], 2.611708807, 1e-7);
  EXPECT_NEAR(std::sqrt(fit->covariance(0, 0)), 1.2371745815, 1e-6);
  EXPECT_NEAR(std::sqrt(fit->covariance(1, 1)), 0.6482245199, 1e-6);
  EXPECT_NEAR(std::sqrt(fit->covariance(2, 2)), 1.9187381503, 1e-6);
  EXPECT_NEAR(fit->log_likelihood, -8.3530207747, 1e-8);
  const Interval wald = wald_interval(*fit, 1);
  EXPECT_NEAR(wald.low, 1.094503102 - 1.959964 * 0.6482245199, 1e-5);
}

TEST(Firth, HasTheProfileIntervalsOfAnotherMaximiser) {
  // R's optim and uniroot on the penalised likelihood written out.
  const Data data = separated();
  const auto fit = firth(data.x, data.y);
  ASSERT_TRUE(fit);
  const double expected[3][2] = {{-5.342236, -0.170222}, {-0.01628791, 2.684766}, {-0.157553, 7.721783}};
  for (int c = 0; c < 3; ++c) {
    const auto interval = profile_interval(data.x, data.y, *fit, c);
    ASSERT_TRUE(interval);
    EXPECT_NEAR(interval->low, expected[c][0], 2e-4) << c;
    EXPECT_NEAR(interval->high, expected[c][1], 2e-4) << c;
  }
}

TEST(Firth, OfATwoByTwoTableIsHalfAnEventMoreInEveryCell) {
  // Rows: 3 events of 10 without, 7 of 7 with.
  Data data{MatrixXd::Ones(17, 2), VectorXd::Zero(17)};
  for (int i = 0; i < 17; ++i) {
    data.x(i, 1) = i < 10 ? 0 : 1;
    data.y[i] = i < 3 || i >= 10 ? 1 : 0;
  }
  const auto fit = firth(data.x, data.y);
  ASSERT_TRUE(fit && fit->converged);
  EXPECT_NEAR(fit->coefficients[0], std::log(3.5 / 7.5), 1e-8);
  EXPECT_NEAR(fit->coefficients[1], std::log(7.5 / 0.5) - std::log(3.5 / 7.5), 1e-8);
}

TEST(Firth, CountsARowOfWeightTwoAsTwoRows) {
  const Data data = separated();
  VectorXd weights = VectorXd::Ones(20);
  weights[3] = 2;
  weights[7] = 0;
  Data copied{MatrixXd(20, 3), VectorXd(20)};
  for (int i = 0; i < 20; ++i) {
    const int from = i == 7 ? 3 : i;
    copied.x.row(i) = data.x.row(from);
    copied.y[i] = data.y[from];
  }
  const auto weighted = firth(data.x, data.y, weights), repeated = firth(copied.x, copied.y);
  ASSERT_TRUE(weighted && repeated);
  EXPECT_TRUE(weighted->coefficients.isApprox(repeated->coefficients, 1e-6));
}

TEST(Firth, HasScoresThatAddUpToNothing) {
  const Data data = separated();
  const auto fit = firth(data.x, data.y);
  ASSERT_TRUE(fit);
  EXPECT_LT(penalised_scores(data.x, data.y, *fit).colwise().sum().cwiseAbs().maxCoeff(), 1e-6);
}

TEST(Firth, IsAtAMaximumWhereverItsStepsBegin) {
  Random random(5);
  for (int drawn = 0; drawn < 30; ++drawn) {
    Data data{MatrixXd::Ones(40, 3), VectorXd(40)};
    for (int i = 0; i < 40; ++i) {
      data.x(i, 1) = random.normal();
      data.x(i, 2) = 10 * random.normal();
      data.y[i] = random.chance(0.15) ? 1 : 0;
    }
    const auto fit = firth(data.x, data.y);
    ASSERT_TRUE(fit && fit->converged);
    const auto again = firth(data.x, data.y, {}, VectorXd::Constant(3, 0.5));
    ASSERT_TRUE(again && again->converged);
    EXPECT_TRUE(fit->coefficients.isApprox(again->coefficients, 1e-5)) << drawn;
  }
}

TEST(Firth, IsNothingWhereColumnsSayTheSame) {
  Data data = separated();
  data.x.col(2) = 2 * data.x.col(1);
  EXPECT_EQ(firth(data.x, data.y).has_value(), false);
}

}  // namespace
}  // namespace relock
