#pragma once

#include <Eigen/Core>

namespace relock::ivt {

/// A mean and the directions in which looks vary most about it, learnt batch by batch: the sequential
/// Karhunen-Loeve algorithm with an updated mean and a forgetting factor, figure 1 of Ross, Lim, Lin and Yang,
/// "Incremental learning for robust visual tracking", IJCV 77 (2008).
///
/// Without forgetting, and while there are no more directions than components, it is what principal component analysis
/// of all looks at once gives.
class Subspace {
 public:
  /// `forgetting`: what was learnt counts that much less with each batch; 1: it does not.
  Subspace(int components, double forgetting) : components_(components), forgetting_(forgetting) {}

  /// Learns the columns of `looks`; there is at least one.
  void learn(const Eigen::MatrixXf& looks);

  /// Of each column, the squared distance from the subspace.
  Eigen::VectorXf squared_distances(const Eigen::MatrixXf& looks) const;

  const Eigen::VectorXd& mean() const { return mean_; }
  const Eigen::MatrixXd& basis() const { return basis_; }  ///< orthonormal columns, none after one look
  const Eigen::VectorXd& singular_values() const { return singular_values_; }

 private:
  int components_;
  double forgetting_;
  double count_ = 0;  // of the looks learnt, as far as they are not forgotten
  Eigen::VectorXd mean_;
  Eigen::MatrixXd basis_;
  Eigen::VectorXd singular_values_;
};

}  // namespace relock::ivt
