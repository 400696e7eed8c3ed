#include <gtest/gtest.h>

#include <Eigen/SVD>

#include "core/random.h"
#include "trackers/ivt/subspace.h"

namespace relock::ivt {
namespace {

/// Looks of 30 samples that vary in five directions.
Eigen::MatrixXf looks(int count, std::uint64_t seed) {
  Random directions(1), random(seed);
  Eigen::MatrixXf mean(30, 1), basis(30, 5), parts(5, count);
  for (auto* matrix : {&mean, &basis})
    for (Eigen::Index i = 0; i < matrix->size(); ++i)
      matrix->data()[i] = static_cast<float>(directions.normal());
  for (Eigen::Index i = 0; i < parts.size(); ++i) parts.data()[i] = static_cast<float>(random.normal());
  return (basis * parts).colwise() + mean.col(0);
}

TEST(Subspace, LearntBatchByBatchIsThatOfAllLooksAtOnce) {
  const Eigen::MatrixXf all = looks(37, 2);
  Subspace subspace(16, 1);
  subspace.learn(all.leftCols(1));
  for (Eigen::Index first = 1; first < all.cols(); first += 6)
    subspace.learn(all.middleCols(first, std::min<Eigen::Index>(6, all.cols() - first)));

  const Eigen::MatrixXd looks = all.cast<double>();
  const Eigen::VectorXd mean = looks.rowwise().mean();
  const Eigen::MatrixXd about_mean = looks.colwise() - mean;
  const Eigen::JacobiSVD<Eigen::MatrixXd> at_once(about_mean, Eigen::ComputeThinU);
  ASSERT_EQ(subspace.basis().cols(), 5);
  EXPECT_LT((subspace.mean() - mean).norm(), 1e-6);
  EXPECT_LT((subspace.singular_values() - at_once.singularValues().head(5)).norm(), 1e-5);
  const Eigen::MatrixXd u = at_once.matrixU().leftCols(5);
  EXPECT_LT((subspace.basis() * subspace.basis().transpose() - u * u.transpose()).norm(), 1e-6);
}

TEST(Subspace, StaysOrthonormalAndHasNoMoreComponentsThanAsked) {
  Subspace subspace(3, 0.95);
  for (std::uint64_t batch = 0; batch < 40; ++batch) subspace.learn(looks(5, batch));
  ASSERT_EQ(subspace.basis().cols(), 3);
  EXPECT_LT((subspace.basis().transpose() * subspace.basis() - Eigen::MatrixXd::Identity(3, 3)).norm(),
            1e-10);
}

TEST(Subspace, IsAtDistanceZeroFromWhatItIsMadeOf) {
  Subspace subspace(16, 1);
  subspace.learn(looks(20, 2));
  EXPECT_LT(subspace.squared_distances(looks(10, 3)).maxCoeff(), 1e-4F);
  Eigen::MatrixXf other = looks(1, 3);
  other.array().row(4) += 10;
  EXPECT_GT(subspace.squared_distances(other)[0], 20);
}

TEST(Subspace, ForgetsWhatWasLearntLongAgo) {
  const auto share_left = [](double forgetting) {
    Subspace subspace(16, forgetting);
    subspace.learn(looks(5, 1));
    const Eigen::VectorXd before = subspace.mean();
    const Eigen::MatrixXf zero = Eigen::MatrixXf::Zero(30, 5);
    for (int i = 0; i < 10; ++i) subspace.learn(zero);
    return subspace.mean().norm() / before.norm();
  };
  EXPECT_NEAR(share_left(1), 1.0 / 11, 1e-6);
  EXPECT_LT(share_left(0.8), 0.04);
}

TEST(Subspace, TakesTheSameLookAgainAndAgain) {
  Subspace subspace(16, 0.95);
  const Eigen::MatrixXf same = looks(1, 4).replicate(1, 5);
  for (int i = 0; i < 10; ++i) subspace.learn(same);
  EXPECT_EQ(subspace.basis().cols(), 0);
  EXPECT_LT(subspace.squared_distances(same).maxCoeff(), 1e-6F);
}

}  // namespace
}  // namespace relock::ivt
