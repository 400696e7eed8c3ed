#include "trackers/blut/sparse_solver.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"

namespace relock::blut {
namespace {

/// Rows are filled up with 0, which change nothing, to whole vectors: a column is read the same way wherever
/// it is.
constexpr Eigen::Index kLanes = 4;

/// So many templates that are not in use are tried in a round. With more, the steps cost more than rounds are
/// saved.
constexpr std::size_t kTried = 4;

/// A template adds to the basis if so much of it is not explained by those before.
constexpr double kNewDirection = 1e-6;

Eigen::Index padded(Eigen::Index pixels) { return (pixels + kLanes - 1) / kLanes * kLanes; }

RobustLoss loss_of(const SolverOptions& options) {
  if (!(options.trivial_weight >= 0 && options.trivial_ridge >= 0 && options.tolerance >= 0))
    throw Error(
        "sparse solver: trivial_weight, trivial_ridge and tolerance must be numbers that are not negative");
  if (options.rounds < 1 || options.sweeps < 1)
    throw Error("sparse solver: rounds and sweeps must be at least 1");
  return {.knee = static_cast<float>(options.trivial_weight),
          .rho = static_cast<float>(options.trivial_ridge / (1 + options.trivial_ridge))};
}

}  // namespace

SparseSolver::SparseSolver(const Eigen::MatrixXf& dictionary, const Eigen::VectorXf& weights,
                           const SolverOptions& options)
    : options_(options),
      loss_(loss_of(options)),
      pixels_(dictionary.rows()),
      dictionary_(Eigen::MatrixXf::Zero(padded(dictionary.rows()), dictionary.cols())),
      steps_(dictionary_.rows(), dictionary_.cols(), loss_),
      residual_(Eigen::ArrayXf::Zero(dictionary_.rows())),
      slopes_(dictionary_.rows()),
      gradient_(dictionary_.cols()) {
  if (dictionary.size() == 0) throw Error("sparse solver: there are no templates");
  if (!dictionary.allFinite()) throw Error("sparse solver: a template has a value that is no number");
  dictionary_.topRows(pixels_) = dictionary;
  chosen_.reserve(static_cast<std::size_t>(templates()));
  set_weights(weights);
  find_basis();
}

void SparseSolver::replace(Eigen::Index column, const Eigen::Ref<const Eigen::VectorXf>& look) {
  if (column < 0 || column >= templates())
    throw Error(fmt::format("sparse solver: template {} does not exist; there are {}", column, templates()));
  check_size(look.size());
  if (!look.allFinite()) throw Error("sparse solver: a template has a value that is no number");
  dictionary_.col(column).head(pixels_) = look;
  find_basis();
}

void SparseSolver::set_weights(const Eigen::VectorXf& weights) {
  if (weights.size() != templates())
    throw Error(fmt::format("sparse solver: {} weights for {} templates", weights.size(), templates()));
  if (!weights.allFinite() || weights.minCoeff() < 0)
    throw Error("sparse solver: weights of templates must be numbers that are not negative");
  weights_ = weights;
}

/// Gram and Schmidt's, in double: rounding errors of float would be blown up where templates are nearly the
/// same.
void SparseSolver::find_basis() {
  Eigen::MatrixXd basis(dictionary_.rows(), templates());
  Eigen::VectorXd direction;
  Eigen::Index size = 0;
  for (Eigen::Index j = 0; j < templates(); ++j) {
    const auto found = basis.leftCols(size);
    direction = dictionary_.col(j).cast<double>();
    const double length = direction.norm();
    direction -= found * (found.transpose() * direction);
    if (direction.norm() > kNewDirection * length) basis.col(size++) = direction.normalized();
  }
  basis_ = basis.leftCols(size).cast<float>();
}

void SparseSolver::bound(const Eigen::Ref<const Eigen::MatrixXf>& looks, Eigen::VectorXf& bounds) const {
  check_size(looks.rows());
  bounds.resize(looks.cols());
  Eigen::VectorXf look = Eigen::VectorXf::Zero(dictionary_.rows()), parts(basis_.cols());
  for (Eigen::Index i = 0; i < looks.cols(); ++i) {
    look.head(pixels_) = looks.col(i);
    parts.noalias() = basis_.transpose() * look;
    bounds(i) = std::max(0.F, look.squaredNorm() - parts.squaredNorm());
  }
}

void SparseSolver::solve(const Eigen::Ref<const Eigen::VectorXf>& look, Solution& solution) {
  Eigen::VectorXf& c = solution.coefficients;
  start(look, c);
  const auto tolerance = static_cast<float>(options_.tolerance);
  for (int round = 0;; ++round) {
    find_gradient();
    solution.kkt_residual = 0;
    for (Eigen::Index j = 0; j < templates(); ++j)
      solution.kkt_residual = std::max(solution.kkt_residual, kkt_residual(c(j), gradient_(j)));
    if (solution.kkt_residual <= tolerance || round == options_.rounds) break;
    choose_templates(c);
    steps_.run(dictionary_, weights_, chosen_, options_.sweeps, tolerance / 2, residual_, c);
  }
  solution.squared_residual = residual_.matrix().squaredNorm();
  solution.objective = loss_.value(residual_) + weights_.dot(c);
}

void SparseSolver::start(const Eigen::Ref<const Eigen::VectorXf>& look, Eigen::VectorXf& coefficients) {
  check_size(look.size());
  if (coefficients.size() != templates()) coefficients.setZero(templates());
  residual_.head(pixels_) = look;
  if (!residual_.allFinite()) throw Error("sparse solver: a look has a value that is no number");
  for (Eigen::Index j = 0; j < templates(); ++j)
    if (coefficients(j) > 0 && std::isfinite(coefficients(j)))
      residual_ -= coefficients(j) * dictionary_.col(j).array();
    else
      coefficients(j) = 0;
}

void SparseSolver::find_gradient() {
  slopes_ = loss_.slope(residual_);
  gradient_ = weights_;
  gradient_.noalias() -= dictionary_.transpose() * slopes_.matrix();
}

/// Those in use, and of the others the few that would lower F most steeply.
void SparseSolver::choose_templates(const Eigen::VectorXf& coefficients) {
  chosen_.clear();
  for (Eigen::Index j = 0; j < templates(); ++j)
    if (coefficients(j) > 0) chosen_.push_back(j);
  for (std::size_t tried = 0; tried < kTried; ++tried) {
    Eigen::Index steepest = -1;
    float slope = 0;
    for (Eigen::Index j = 0; j < templates(); ++j)
      if (coefficients(j) <= 0 && gradient_(j) < slope) {
        steepest = j;
        slope = gradient_(j);
      }
    if (steepest < 0) return;
    chosen_.push_back(steepest);
    gradient_(steepest) = 0;  // not again; the next round finds it anew
  }
}

void SparseSolver::solve(const Eigen::Ref<const Eigen::MatrixXf>& looks, Solutions& solutions) {
  const Eigen::Index count = looks.cols();
  if (solutions.coefficients.rows() != templates() || solutions.coefficients.cols() != count)
    solutions.coefficients.setZero(templates(), count);
  solutions.objectives.resize(count);
  solutions.squared_residuals.resize(count);
  solutions.kkt_residuals.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    one_.coefficients = solutions.coefficients.col(i);
    solve(looks.col(i), one_);
    solutions.coefficients.col(i) = one_.coefficients;
    solutions.objectives(i) = one_.objective;
    solutions.squared_residuals(i) = one_.squared_residual;
    solutions.kkt_residuals(i) = one_.kkt_residual;
  }
}

Eigen::VectorXf SparseSolver::trivial(const Eigen::Ref<const Eigen::VectorXf>& look,
                                      const Eigen::Ref<const Eigen::VectorXf>& coefficients) const {
  check_size(look.size());
  if (coefficients.size() != templates())
    throw Error(
        fmt::format("sparse solver: {} coefficients for {} templates", coefficients.size(), templates()));
  const Eigen::ArrayXf residual = look - dictionary_.topRows(pixels_) * coefficients;
  return residual - loss_.slope(residual);
}

void SparseSolver::check_size(Eigen::Index pixels) const {
  if (pixels != pixels_)
    throw Error(fmt::format("sparse solver: a look of {} pixels; the templates have {}", pixels, pixels_));
}

}  // namespace relock::blut
