#include "trackers/ivt/subspace.h"

#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

namespace relock::ivt {
namespace {

constexpr double kLeastSingular = 1e-6;  // of the mean and the largest: below, a direction is rounding

}  // namespace

void Subspace::learn(const Eigen::MatrixXf& looks) {
  const Eigen::MatrixXd batch = looks.cast<double>();
  const auto fresh = static_cast<double>(batch.cols());
  const Eigen::VectorXd batch_mean = batch.rowwise().mean();
  const double old = forgetting_ * count_;
  if (count_ == 0) {
    mean_ = batch_mean;
    basis_.resize(batch.rows(), 0);
    singular_values_.resize(0);
  }

  // The batch about its own mean, and one more column for the way from the old mean to it.
  Eigen::MatrixXd added(batch.rows(), batch.cols() + 1);
  added.leftCols(batch.cols()) = batch.colwise() - batch_mean;
  added.rightCols(1) = std::sqrt(old * fresh / (old + fresh)) * (batch_mean - mean_);
  mean_ = (old * mean_ + fresh * batch_mean) / (old + fresh);
  count_ = old + fresh;

  // What the basis has of it, and an orthonormal basis of the rest.
  const Eigen::MatrixXd known = basis_.transpose() * added;
  const Eigen::MatrixXd rest = added - basis_ * known;
  const Eigen::Index had = basis_.cols(), width = std::min(rest.rows(), rest.cols());
  const Eigen::HouseholderQR<Eigen::MatrixXd> factors(rest);
  const Eigen::MatrixXd beyond = factors.householderQ() * Eigen::MatrixXd::Identity(rest.rows(), width);

  Eigen::MatrixXd joint = Eigen::MatrixXd::Zero(had + width, had + added.cols());
  joint.topLeftCorner(had, had) = (forgetting_ * singular_values_).asDiagonal();
  joint.topRightCorner(had, added.cols()) = known;
  joint.bottomRightCorner(width, added.cols()) = beyond.transpose() * rest;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(joint, Eigen::ComputeThinU);

  const Eigen::VectorXd& all = svd.singularValues();
  Eigen::Index kept = 0;
  while (kept < std::min<Eigen::Index>(components_, all.size()) &&
         all[kept] > kLeastSingular * (all[0] + mean_.norm()))
    ++kept;
  Eigen::MatrixXd both(batch.rows(), had + width);
  both << basis_, beyond;
  basis_ = both * svd.matrixU().leftCols(kept);
  singular_values_ = all.head(kept);
}

Eigen::VectorXf Subspace::squared_distances(const Eigen::MatrixXf& looks) const {
  const Eigen::MatrixXf about_mean = looks.colwise() - mean_.cast<float>();
  const Eigen::MatrixXf within = basis_.cast<float>().transpose() * about_mean;
  return (about_mean.colwise().squaredNorm() - within.colwise().squaredNorm()).cwiseMax(0.0F);
}

}  // namespace relock::ivt
