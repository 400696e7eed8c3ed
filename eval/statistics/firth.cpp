#include "eval/statistics/firth.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace relock {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Problem {
  const MatrixXd& covariates;
  const VectorXd& events;
  const VectorXd& weights;  // empty: all 1
  double weight(Index row) const { return weights.size() == 0 ? 1 : weights[row]; }
};

/// The penalised likelihood at one point, and what a step from there needs.
struct Local {
  VectorXd score;  // penalised
  MatrixXd information;
  double log_likelihood = 0;  // penalised
  bool regular = false;
};

Local look(const Problem& problem, const VectorXd& at) {
  const MatrixXd& x = problem.covariates;
  const VectorXd linear = x * at;
  Local here;
  VectorXd chance(x.rows()), spread(x.rows());
  for (Index i = 0; i < x.rows(); ++i) {
    const double w = problem.weight(i);
    const double rarer = std::exp(-std::abs(linear[i]));  // never overflows
    chance[i] = (linear[i] > 0 ? 1 : rarer) / (1 + rarer);
    spread[i] = w * chance[i] * (1 - chance[i]);
    here.log_likelihood += w * (problem.events[i] * linear[i] - std::max(linear[i], 0.0) - std::log1p(rarer));
  }
  const MatrixXd scaled = spread.asDiagonal() * x;
  here.information = x.transpose() * scaled;
  const Eigen::LLT<MatrixXd> cholesky(here.information);
  if (cholesky.info() != Eigen::Success) return here;
  const VectorXd diagonal = MatrixXd(cholesky.matrixL()).diagonal();
  if (diagonal.minCoeff() <= 1e-12 * diagonal.maxCoeff()) return here;
  here.log_likelihood += diagonal.array().log().sum();  // log det / 2
  const MatrixXd inverse = cholesky.solve(MatrixXd::Identity(x.cols(), x.cols()));
  const VectorXd forms = (x * inverse).cwiseProduct(x).rowwise().sum();
  VectorXd residual(x.rows());
  for (Index i = 0; i < x.rows(); ++i) {
    const double leverage = spread[i] * forms[i];
    residual[i] = problem.weight(i) * (problem.events[i] - chance[i]) + leverage * (0.5 - chance[i]);
  }
  here.score = x.transpose() * residual;
  here.regular = true;
  return here;
}

/// Steps up the penalised likelihood; the coefficient `held` keeps its value if it is not negative.
std::optional<FirthFit> climb(const Problem& problem, VectorXd at, Index held, const FirthOptions& options) {
  constexpr double kLongestStep = 5;  // in log odds a unit: the likelihood is flat far out
  Local here = look(problem, at);
  if (!here.regular) return {};
  FirthFit fit;
  for (; fit.steps < options.most_steps; ++fit.steps) {
    VectorXd score = here.score;
    MatrixXd information = here.information;
    if (held >= 0) {
      score[held] = 0;
      information.row(held).setZero();
      information.col(held).setZero();
      information(held, held) = 1;
    }
    VectorXd step = information.llt().solve(score);
    if (score.dot(step) <= options.gain) {
      fit.converged = true;
      break;
    }
    step *= std::min(1.0, kLongestStep / step.cwiseAbs().maxCoeff());
    Local there = look(problem, at + step);
    for (int halvings = 0; halvings < 40; ++halvings) {
      if (there.regular && there.log_likelihood >= here.log_likelihood - 1e-12) break;
      step /= 2;
      there = look(problem, at + step);
    }
    if (!there.regular) break;
    at += step;
    here = std::move(there);
  }
  fit.coefficients = at;
  fit.covariance = here.information.llt().solve(MatrixXd::Identity(at.size(), at.size()));
  fit.log_likelihood = here.log_likelihood;
  return fit;
}

}  // namespace

std::optional<FirthFit> firth(const MatrixXd& covariates, const VectorXd& events, const VectorXd& weights,
                              const VectorXd& from, const FirthOptions& options) {
  const VectorXd start = from.size() == 0 ? VectorXd(VectorXd::Zero(covariates.cols())) : from;
  return climb({covariates, events, weights}, start, -1, options);
}

Interval wald_interval(const FirthFit& fit, Index coefficient) {
  const double half = normal_quantile() * std::sqrt(fit.covariance(coefficient, coefficient));
  return {fit.coefficients[coefficient] - half, fit.coefficients[coefficient] + half};
}

MatrixXd penalised_scores(const MatrixXd& covariates, const VectorXd& events, const FirthFit& fit) {
  const VectorXd linear = covariates * fit.coefficients;
  MatrixXd scores = covariates;
  for (Index i = 0; i < covariates.rows(); ++i) {
    const double chance = 1 / (1 + std::exp(-linear[i]));
    const double leverage =
        chance * (1 - chance) * covariates.row(i) * fit.covariance * covariates.row(i).transpose();
    scores.row(i) *= events[i] - chance + leverage * (0.5 - chance);
  }
  return scores;
}

std::optional<Interval> profile_interval(const MatrixXd& covariates, const VectorXd& events,
                                         const FirthFit& fit, Index coefficient) {
  const VectorXd once;
  const Problem problem{covariates, events, once};
  const double least = fit.log_likelihood - normal_quantile() * normal_quantile() / 2;
  const double step = std::sqrt(fit.covariance(coefficient, coefficient));
  VectorXd from = fit.coefficients;
  const auto above = [&](double value) {
    VectorXd start = from;
    start[coefficient] = value;
    const auto profile = climb(problem, start, coefficient, {100, 1e-10});
    if (!profile) return false;
    from = profile->coefficients;
    return profile->log_likelihood >= least;
  };
  const auto end = [&](double direction) -> std::optional<double> {
    from = fit.coefficients;
    double inside = fit.coefficients[coefficient], outside = inside;
    for (int doublings = 0;; ++doublings) {
      if (doublings == 12) return {};
      outside = inside + direction * step * std::pow(2, doublings);
      if (!above(outside)) break;
      inside = outside;
    }
    while (std::abs(outside - inside) > 1e-7 * (1 + std::abs(inside))) {
      const double middle = (inside + outside) / 2;
      (above(middle) ? inside : outside) = middle;
    }
    return inside;
  };
  const auto low = end(-1), high = end(1);
  if (!low || !high) return {};
  return Interval{*low, *high};
}

}  // namespace relock
