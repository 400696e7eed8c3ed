#include "sequences/labelling/smooth_curve.h"

#include <ceres/ceres.h>

#include <Eigen/Sparse>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unsupported/Eigen/Splines>

namespace relock {
namespace {

using Spline = Eigen::Spline<double, 1, 3>;
using Sparse = Eigen::SparseMatrix<double>;
using Knots = Spline::KnotVectorType;

constexpr int kDegree = 3, kOrder = kDegree + 1;
// Pieces of the curve between two readings: with four it bends about as freely as its prior; two do to compare models.
constexpr int kPieces = 4, kFewPieces = 2;
constexpr double kHuber = 3;  // sigmas
constexpr double kLeastTold = 1e-9;

/// A linear function of four coefficients in a row.
struct Row {
  int first = 0;
  std::array<double, kOrder> weight{};
};

/// The space of curves over some readings' times.
class Basis {
 public:
  Basis(const std::vector<double>& at_s, int pieces) {
    std::vector<double> breaks;
    for (std::size_t i = 0; i + 1 < at_s.size(); ++i)
      for (int piece = 0; piece < pieces; ++piece)
        breaks.push_back(at_s[i] + (at_s[i + 1] - at_s[i]) * piece / pieces);
    breaks.push_back(at_s.back());
    knots_.resize(static_cast<Eigen::Index>(breaks.size()) + 2 * kDegree);
    for (Eigen::Index k = 0; k < knots_.size(); ++k)
      knots_[k] = breaks[static_cast<std::size_t>(
          std::clamp<Eigen::Index>(k - kDegree, 0, static_cast<Eigen::Index>(breaks.size()) - 1))];
  }

  int size() const { return static_cast<int>(knots_.size()) - kOrder; }
  Row value(double at_s) const { return row(at_s, 0); }

  /// Rows whose squares add up to the integral of the squared derivative, which is straight between knots at order 2 and
  /// level at order 3: two points each of Gauss's are exact.
  std::vector<Row> bends(int order) const {
    std::vector<Row> rows;
    for (Eigen::Index k = kDegree; k + kDegree + 1 < knots_.size(); ++k) {
      const double half = (knots_[k + 1] - knots_[k]) / 2, middle = (knots_[k + 1] + knots_[k]) / 2;
      for (const double side : {-1 / std::sqrt(3.0), 1 / std::sqrt(3.0)}) {
        Row bend = row(middle + side * half, order);
        for (double& weight : bend.weight) weight *= std::sqrt(half);
        rows.push_back(bend);
      }
    }
    return rows;
  }

  /// Where the coefficients of a straight line lie on it.
  double abscissa(int coefficient) const { return knots_.segment(coefficient + 1, kDegree).mean(); }

 private:
  Row row(double at_s, int derivative) const {
    const double at = std::clamp(at_s, knots_[0], knots_[knots_.size() - 1]);
    Row result;
    result.first = static_cast<int>(Spline::Span(at, kDegree, knots_)) - kDegree;
    const auto all = Spline::BasisFunctionDerivatives(at, derivative, kDegree, knots_);
    for (int i = 0; i < kOrder; ++i) result.weight[static_cast<std::size_t>(i)] = all(derivative, i);
    return result;
  }

  Knots knots_;
};

void add_square(const Row& row, double weight, std::vector<Eigen::Triplet<double>>& entries) {
  for (int i = 0; i < kOrder; ++i)
    for (int k = 0; k < kOrder; ++k)
      entries.emplace_back(
          row.first + i, row.first + k,
          weight * row.weight[static_cast<std::size_t>(i)] * row.weight[static_cast<std::size_t>(k)]);
}

Eigen::VectorXd dense(const Row& row, int size) {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(size);
  for (int i = 0; i < kOrder; ++i) result[row.first + i] = row.weight[static_cast<std::size_t>(i)];
  return result;
}

using Solver = Eigen::SimplicialLDLT<Sparse>;

double noise(const Readings& readings, std::size_t i, const CurveModel& model) {
  return std::hypot(readings.sigma[i], model.tremor);
}

/// Of the normal equations: what readings and bends together say of the coefficients.
void factorise(const Basis& basis, const Readings& readings, const CurveModel& model, Solver& solver) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t i = 0; i < readings.at_s.size(); ++i)
    add_square(basis.value(readings.at_s[i]), std::pow(noise(readings, i, model), -2), entries);
  for (const Row& bend : basis.bends(model.order)) add_square(bend, 1 / model.restlessness, entries);
  Sparse normal(basis.size(), basis.size());
  normal.setFromTriplets(entries.begin(), entries.end());
  solver.compute(normal);
}

double variance(const Solver& solver, const Row& row, int size) {
  const Eigen::VectorXd along = dense(row, size);
  return std::max(0.0, along.dot(solver.solve(along)));
}

/// weight * (row . coefficients - value), for Ceres.
class Residual : public ceres::SizedCostFunction<1, 1, 1, 1, 1> {
 public:
  Residual(const Row& row, double value, double weight) : row_(row), value_(value), weight_(weight) {}
  bool Evaluate(double const* const* coefficients, double* residual, double** jacobians) const override {
    residual[0] = -weight_ * value_;
    for (std::size_t i = 0; i < kOrder; ++i) {
      residual[0] += weight_ * row_.weight[i] * coefficients[i][0];
      if (jacobians != nullptr && jacobians[i] != nullptr) jacobians[i][0] = weight_ * row_.weight[i];
    }
    return true;
  }

 private:
  Row row_;
  double value_, weight_;
};

/// Of the readings joined by straight lines.
double joined(const Readings& readings, double at_s) {
  const auto& at = readings.at_s;
  const auto after = static_cast<std::size_t>(std::upper_bound(at.begin(), at.end(), at_s) - at.begin());
  if (after == 0) return readings.value.front();
  if (after == at.size()) return readings.value.back();
  const double part = (at_s - at[after - 1]) / (at[after] - at[after - 1]);
  return readings.value[after - 1] + part * (readings.value[after] - readings.value[after - 1]);
}

std::vector<double> coefficients(const Basis& basis, const Readings& readings, const CurveModel& model) {
  std::vector<double> result;
  for (int i = 0; i < basis.size(); ++i) result.push_back(joined(readings, basis.abscissa(i)));
  ceres::Problem problem;
  const auto add = [&](const Row& row, double value, double weight, ceres::LossFunction* loss) {
    double* c = result.data() + row.first;
    problem.AddResidualBlock(new Residual(row, value, weight), loss, c, c + 1, c + 2, c + 3);
  };
  for (std::size_t i = 0; i < readings.at_s.size(); ++i)
    add(basis.value(readings.at_s[i]), readings.value[i], 1 / readings.sigma[i],
        new ceres::HuberLoss(kHuber));
  for (const Row& bend : basis.bends(model.order)) add(bend, 0, 1 / std::sqrt(model.restlessness), nullptr);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.initial_trust_region_radius = 1e14;  // but for the loss it is linear: a single step
  options.max_trust_region_radius = 1e16;
  options.function_tolerance = 1e-14;
  options.parameter_tolerance = 1e-14;
  options.gradient_tolerance = 1e-14;
  options.max_num_iterations = 30;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return result;
}

std::vector<std::optional<LeftOut>> leave_out(const Readings& readings, const CurveModel& model, int pieces) {
  const std::size_t count = readings.at_s.size();
  std::vector<std::optional<LeftOut>> result(count);
  if (count < 3) return result;
  const Basis basis(readings.at_s, pieces);
  Solver solver;
  factorise(basis, readings, model, solver);
  std::vector<Row> rows;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(basis.size());
  for (std::size_t i = 0; i < count; ++i) {
    rows.push_back(basis.value(readings.at_s[i]));
    right += readings.value[i] * std::pow(noise(readings, i, model), -2) * dense(rows.back(), basis.size());
  }
  const Eigen::VectorXd solved = solver.solve(right);
  for (std::size_t i = 0; i < count; ++i) {
    const double of_reading = std::pow(noise(readings, i, model), 2);
    // What the reading itself has to say in the curve there: leaving it out divides by the rest.
    const double rest = 1 - variance(solver, rows[i], basis.size()) / of_reading;
    if (rest < kLeastTold) continue;
    const double error = readings.value[i] - dense(rows[i], basis.size()).dot(solved);
    result[i] = LeftOut{error / rest, std::sqrt(of_reading / rest)};
  }
  return result;
}

/// How little likely left-out readings are: minus the logarithm, but for a constant; an outlier counts as Huber has it.
double surprise(std::span<const Readings> tracks, const CurveModel& model) {
  double sum = 0;
  for (const Readings& track : tracks) {
    const auto left_out = leave_out(track, model, kFewPieces);
    for (std::size_t i = 0; i < left_out.size(); ++i) {
      // A model that has nothing to say is as bad as one that says that it could be anywhere.
      const LeftOut left = left_out[i].value_or(LeftOut{0, noise(track, i, model) / std::sqrt(kLeastTold)});
      const double z = std::abs(left.error) / left.sigma;
      sum += std::log(left.sigma) + (z <= kHuber ? z * z / 2 : kHuber * (z - kHuber / 2));
    }
  }
  return sum;
}

/// Looks for the least cost, coordinate by coordinate.
class ModelSearch {
 public:
  ModelSearch(std::span<const Readings> tracks, double usual) : tracks_(tracks), usual_(usual) {
    std::vector<double> sigmas;
    for (const Readings& track : tracks) sigmas.insert(sigmas.end(), track.sigma.begin(), track.sigma.end());
    const auto middle = sigmas.begin() + static_cast<std::ptrdiff_t>(sigmas.size() / 2);
    std::nth_element(sigmas.begin(), middle, sigmas.end());
    sigma_ = *middle;
  }

  void try_order(int order) {
    double best = 0, least = std::numeric_limits<double>::infinity();
    const auto look = [&](double at) {
      if (const double c = look_at(order, at, 0); c < least) least = c, best = at;
    };
    for (double at = -kReach; at <= kReach; at += kCoarse) look(at);
    refine(look, best, kCoarse / 2);
  }

  /// About the best so far: the more trembles, the calmer the curve may be.
  void try_tremor() {
    const int order = best_.order;
    double best = best_log_, least = std::numeric_limits<double>::infinity();
    for (const double tremor : {0.5, 1.0, 2.0, 4.0, 8.0, 16.0}) {
      const auto look = [&](double at) {
        if (const double c = look_at(order, at, tremor * sigma_); c < least) least = c, best = at;
      };
      refine(look, best, kCoarse);
    }
  }

  /// The most restless one that is hardly less likely than the best: of few readings, the calmest explanation is often
  /// the best one, and too sure of itself.
  CurveModel cautious() {
    const CurveModel best = best_;
    const double least = least_, log_ratio = best_log_;
    CurveModel result = best;
    for (double more = kStep; more <= kReach; more += kStep) {
      if (look_at(best.order, log_ratio + more, best.tremor) > least + kHardlyLess) break;
      result.restlessness = best.restlessness * std::exp(more);
    }
    return result;
  }

 private:
  // Of the logarithm of restlessness: the usual is known within a factor of five.
  static constexpr double kSpread = 1.5;
  static constexpr double kReach = 14;  // searched to either side of the usual
  static constexpr double kCoarse = 2, kFine = 0.1, kStep = 0.25;
  static constexpr double kHardlyLess = 2;
  static constexpr double kPerSecond2 = 9;  // order 3: changes at about 3 rad/s are usual
  // What must be outweighed by the readings. Order 3 says that a curve that misses readings by much, when two gaps are
  // left between the others, misses by little within one: of a camera that jerks now and then that is wrong.
  static constexpr double kDoubtOfTremor = 1.5, kDoubtOfOrder3 = 5;

  template <class Look>
  static void refine(const Look& look, double& best, double step) {
    for (; step > kFine; step /= 2) {
      const double middle = best;
      look(middle - step);
      look(middle + step);
    }
  }

  double look_at(int order, double log_ratio, double tremor) {
    const double unit = order == 3 ? usual_ * kPerSecond2 : usual_;
    const CurveModel model{order, unit * std::exp(log_ratio), tremor};
    const double cost = surprise(tracks_, model) + log_ratio * log_ratio / (2 * kSpread * kSpread) +
                        (tremor > 0 ? kDoubtOfTremor : 0) + (order == 3 ? kDoubtOfOrder3 : 0);
    if (cost < least_) {
      least_ = cost;
      best_ = model;
      best_log_ = log_ratio;
    }
    return cost;
  }

  std::span<const Readings> tracks_;
  double usual_, sigma_ = 1;
  CurveModel best_;
  double best_log_ = 0, least_ = std::numeric_limits<double>::infinity();
};

}  // namespace

struct SmoothCurve::Fit {
  explicit Fit(const std::vector<double>& at_s) : basis(at_s, kPieces) {}
  Basis basis;
  std::vector<double> coefficients;
  Solver solver;
  double tremor = 0;
};

SmoothCurve::SmoothCurve(const Readings& readings, const CurveModel& model) {
  auto fit = std::make_unique<Fit>(readings.at_s);
  fit->coefficients = coefficients(fit->basis, readings, model);
  factorise(fit->basis, readings, model, fit->solver);
  fit->tremor = model.tremor;
  fit_ = std::move(fit);
}

SmoothCurve::~SmoothCurve() = default;
SmoothCurve::SmoothCurve(SmoothCurve&&) noexcept = default;

double SmoothCurve::value(double at_s) const {
  const Row row = fit_->basis.value(at_s);
  double sum = 0;
  for (std::size_t i = 0; i < kOrder; ++i)
    sum += row.weight[i] * fit_->coefficients[static_cast<std::size_t>(row.first) + i];
  return sum;
}

double SmoothCurve::sigma(double at_s) const {
  return std::hypot(std::sqrt(variance(fit_->solver, fit_->basis.value(at_s), fit_->basis.size())),
                    fit_->tremor);
}

std::vector<std::optional<LeftOut>> leave_each_out(const Readings& readings, const CurveModel& model) {
  return leave_out(readings, model, kPieces);
}

CurveModel likely_model(std::span<const Readings> tracks, double usual, Models models) {
  const bool any =
      std::any_of(tracks.begin(), tracks.end(), [](const Readings& t) { return t.at_s.size() > 2; });
  if (!any) return {2, usual, 0};
  ModelSearch search(tracks, usual);
  search.try_order(2);
  if (models == Models::all) {
    search.try_order(3);
    search.try_tremor();
  }
  return search.cautious();
}

}  // namespace relock
