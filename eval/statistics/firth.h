#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "eval/statistics/interval.h"

namespace relock {

/// A logistic regression with Firth's penalty (Firth 1993; Heinze and Schemper 2002): the likelihood times the
/// square root of the information's determinant. Estimates are finite even where a covariate separates events
/// from non-events, and less biased where events are few.
struct FirthFit {
  Eigen::VectorXd coefficients;  ///< log odds for each unit of each column
  Eigen::MatrixXd covariance;    ///< inverse of the information there
  double log_likelihood = 0;     ///< penalised
  bool converged = false;        ///< else the coefficients are where the steps ended
  int steps = 0;
};

struct FirthOptions {
  int most_steps = 100;
  double gain = 1e-18;  ///< converged when the next step would raise the penalised log likelihood by less
};

/// Fits `events` (0 or 1, or a share) to `covariates`: one row each, one column for each coefficient; a column of
/// ones is the intercept. `weights`: how often each row counts; empty: once. `from`: where the steps begin; empty:
/// zero. Newton's steps on the penalised score, halved until the penalised likelihood grows.
/// Nothing when the columns are not independent (one does not vary, or two say the same), so that nothing can be
/// told apart.
std::optional<FirthFit> firth(const Eigen::MatrixXd& covariates, const Eigen::VectorXd& events,
                              const Eigen::VectorXd& weights = {}, const Eigen::VectorXd& from = {},
                              const FirthOptions& options = {});

/// What each row adds to the penalised score at the fit, row by row; they add up to zero. For intervals that do
/// not take rows for independent.
Eigen::MatrixXd penalised_scores(const Eigen::MatrixXd& covariates, const Eigen::VectorXd& events,
                                 const FirthFit& fit);

/// 95 % interval of one coefficient, by the normal distribution. Poor where events are few.
Interval wald_interval(const FirthFit& fit, Eigen::Index coefficient);
/// 95 % interval of one coefficient: where the penalised likelihood, highest over the others, falls by half the
/// 95 % quantile of chi-squared. Rows are taken for independent. Nothing when an end is not found.
std::optional<Interval> profile_interval(const Eigen::MatrixXd& covariates, const Eigen::VectorXd& events,
                                         const FirthFit& fit, Eigen::Index coefficient);

}  // namespace relock
