#include "trackers/blut/sparse_solver.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>

#include "core/error.h"

namespace relock::blut {
namespace {

void check(const SolverOptions& options) {
  if (!(options.trivial_weight >= 0) || !(options.trivial_ridge >= 0) || !(options.tolerance >= 0) ||
      options.rounds < 1 || options.sweeps < 1)
    throw Error("sparse solver: weights and tolerance must not be negative, rounds and sweeps at least 1");
}

}  // namespace

SparseSolver::SparseSolver(const Eigen::MatrixXf& dictionary, const Eigen::VectorXf& weights,
                           const SolverOptions& options)
    : dictionary_(dictionary), options_(options) {
  check(options);
  if (dictionary.size() == 0) throw Error("sparse solver: there are no templates");
  gram_ = dictionary_.transpose() * dictionary_;
  set_weights(weights);
  prepare_bound();
}

void SparseSolver::replace(Eigen::Index column, const Eigen::Ref<const Eigen::VectorXf>& look) {
  if (column < 0 || column >= templates() || look.size() != pixels())
    throw Error(fmt::format("sparse solver: no template {} of {} pixels", column, look.size()));
  dictionary_.col(column) = look;
  gram_.col(column) = dictionary_.transpose() * look;
  gram_.row(column) = gram_.col(column).transpose();
  prepare_bound();
}

void SparseSolver::set_weights(const Eigen::VectorXf& weights) {
  if (weights.size() != templates() || !(weights.minCoeff() >= 0) || !weights.allFinite())
    throw Error(fmt::format("sparse solver: it needs {} weights, none negative", templates()));
  weights_ = weights;
}

void SparseSolver::prepare_bound() {
  Eigen::ColPivHouseholderQR<Eigen::MatrixXf> qr(dictionary_);
  qr.setThreshold(1e-5F);
  basis_ = qr.householderQ() * Eigen::MatrixXf::Identity(pixels(), qr.rank());
}

void SparseSolver::bound(const Eigen::Ref<const Eigen::MatrixXf>& looks, Eigen::VectorXf& bounds) const {
  bounds = looks.colwise().squaredNorm() - (basis_.transpose() * looks).colwise().squaredNorm();
  bounds = bounds.cwiseMax(0);
}

Eigen::VectorXf SparseSolver::trivial(const Eigen::Ref<const Eigen::VectorXf>& look,
                                      const Eigen::Ref<const Eigen::VectorXf>& coefficients) const {
  const auto knee = static_cast<float>(options_.trivial_weight);
  const Eigen::ArrayXf r = look - dictionary_ * coefficients;
  return (r - r.max(-knee).min(knee)) / (1 + static_cast<float>(options_.trivial_ridge));
}

void SparseSolver::solve(const Eigen::Ref<const Eigen::VectorXf>& look, Solution& solution) {
  if (look.size() != pixels())
    throw Error(fmt::format("sparse solver: a look of {} pixels, templates of {}", look.size(), pixels()));
  Eigen::VectorXf& c = solution.coefficients;
  if (c.size() != templates()) c.setZero(templates());
  c = c.unaryExpr([](float v) { return v > 0 && v <= 1e6F ? v : 0.F; });
  const auto knee = static_cast<float>(options_.trivial_weight),
             ridge = static_cast<float>(options_.trivial_ridge);
  for (int round = 0;; ++round) {
    const Eigen::VectorXf residual = look - dictionary_ * c, e = trivial(look, c);
    Eigen::VectorXf gradient = weights_ - dictionary_.transpose() * (residual - e);
    solution.kkt_residual = 0;
    for (Eigen::Index j = 0; j < c.size(); ++j)
      solution.kkt_residual =
          std::max(solution.kkt_residual, c(j) > 0 ? std::abs(gradient(j)) : -gradient(j));
    if (round == options_.rounds || static_cast<double>(solution.kkt_residual) <= options_.tolerance) {
      solution.squared_residual = residual.squaredNorm();
      solution.objective = 0.5F * (residual - e).squaredNorm() + weights_.dot(c) + knee * e.lpNorm<1>() +
                           0.5F * ridge * e.squaredNorm();
      return;
    }
    for (int sweep = 0; sweep < options_.sweeps; ++sweep)
      for (Eigen::Index j = 0; j < c.size(); ++j) {
        const float moved = std::max(0.F, c(j) - gradient(j) / gram_(j, j)) - c(j);
        if (moved == 0) continue;
        c(j) += moved;
        gradient += moved * gram_.col(j);
      }
  }
}

void SparseSolver::solve(const Eigen::Ref<const Eigen::MatrixXf>& looks, Solutions& solutions) {
  const Eigen::Index count = looks.cols();
  if (solutions.coefficients.rows() != templates() || solutions.coefficients.cols() != count)
    solutions.coefficients.setZero(templates(), count);
  solutions.objectives.resize(count);
  solutions.squared_residuals.resize(count);
  solutions.kkt_residuals.resize(count);
  Solution one;
  for (Eigen::Index i = 0; i < count; ++i) {
    one.coefficients = solutions.coefficients.col(i);
    solve(looks.col(i), one);
    solutions.coefficients.col(i) = one.coefficients;
    solutions.objectives(i) = one.objective;
    solutions.squared_residuals(i) = one.squared_residual;
    solutions.kkt_residuals(i) = one.kkt_residual;
  }
}

}  // namespace relock::blut
