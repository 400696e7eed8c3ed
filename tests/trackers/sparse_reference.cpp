#include "tests/trackers/sparse_reference.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <stdexcept>

namespace relock {
namespace {

using Eigen::ArrayXd, Eigen::MatrixXd, Eigen::VectorXd;

/// How far all of `x` > 0 can go along `change` and stay positive, at most 1.
double longest_step(const ArrayXd& x, const ArrayXd& change) {
  double step = 1;
  for (Eigen::Index i = 0; i < x.size(); ++i)
    if (change(i) < 0) step = std::min(step, -0.99 * x(i) / change(i));
  return step;
}

/// Unknowns c, u, v >= 0, or what belongs to each of them.
struct Unknowns {
  ArrayXd c, u, v;

  Unknowns operator*(const Unknowns& o) const { return {c * o.c, u * o.u, v * o.v}; }
  double sum() const { return c.sum() + u.sum() + v.sum(); }
  double longest(const Unknowns& change) const {
    return std::min({longest_step(c, change.c), longest_step(u, change.u), longest_step(v, change.v)});
  }
  void add(double step, const Unknowns& change) {
    c += step * change.c;
    u += step * change.u;
    v += step * change.v;
  }
};

}  // namespace

double ExplicitProblem::objective(const VectorXd& look, const VectorXd& c, const VectorXd& e) const {
  const ArrayXd u = e.array().max(0), v = (-e.array()).max(0);
  return 0.5 * (look - dictionary * c - e).squaredNorm() + weights.dot(c) + trivial_weight * (u + v).sum() +
         0.5 * trivial_ridge * (u - v).square().sum();
}

// Primal and dual path following (Nocedal and Wright, Numerical Optimization, chapter 16.6). `s` are the
// multipliers of the unknowns; a step solves (Q + s/x) dx = -gradient + target/x. By pixel, u and v are two
// unknowns that are coupled with each other and, through D, with c: they are eliminated, what is left has n
// unknowns.
double ExplicitProblem::interior_point(const VectorXd& look) const {
  const Eigen::Index n = dictionary.cols(), d = dictionary.rows();
  const double kappa = 1 + trivial_ridge;
  Unknowns x{ArrayXd::Constant(n, 0.1), ArrayXd::Constant(d, 0.1), ArrayXd::Constant(d, 0.1)}, s = x;
  for (int step = 0; step < 100; ++step) {
    const ArrayXd e = x.u - x.v;
    const VectorXd left = look - dictionary * x.c.matrix() - e.matrix();
    const double value = objective(look, x.c, e);
    const Unknowns gradient{weights.array() - (dictionary.transpose() * left).array(),
                            trivial_weight + trivial_ridge * e - left.array(),
                            trivial_weight - trivial_ridge * e + left.array()};
    const double gap = (x * s).sum(), infeasible = std::max({(gradient.c - s.c).abs().maxCoeff(),
                                                             (gradient.u - s.u).abs().maxCoeff(),
                                                             (gradient.v - s.v).abs().maxCoeff()});
    if (gap < 1e-4 * value && infeasible < 1e-7) return value;
    const double target = 0.1 * gap / static_cast<double>(n + 2 * d);
    const Unknowns theta{s.c / x.c, s.u / x.u, s.v / x.v};
    const Unknowns right{target / x.c - gradient.c, target / x.u - gradient.u, target / x.v - gradient.v};
    const ArrayXd det = kappa * (theta.u + theta.v) + theta.u * theta.v;
    const MatrixXd scaled = (1 - (theta.u + theta.v) / det).sqrt().matrix().asDiagonal() * dictionary;
    MatrixXd matrix = MatrixXd::Zero(n, n);
    matrix.selfadjointView<Eigen::Lower>().rankUpdate(scaled.transpose());
    matrix.diagonal().array() += theta.c;
    Unknowns change;
    change.c = matrix.selfadjointView<Eigen::Lower>()
                   .llt()
                   .solve(right.c.matrix() -
                          dictionary.transpose() * ((theta.v * right.u - theta.u * right.v) / det).matrix())
                   .array();
    const ArrayXd p = (dictionary * change.c.matrix()).array();
    change.u = ((kappa + theta.v) * right.u + kappa * right.v - theta.v * p) / det;
    change.v = ((kappa + theta.u) * right.v + kappa * right.u + theta.u * p) / det;
    const Unknowns multipliers{target / x.c - s.c - theta.c * change.c,
                               target / x.u - s.u - theta.u * change.u,
                               target / x.v - s.v - theta.v * change.v};
    const double length = std::min(x.longest(change), s.longest(multipliers));
    x.add(length, change);
    s.add(length, multipliers);
  }
  throw std::runtime_error("the interior point method did not end");
}

// For any nu with D'nu <= w, and the conjugate phi* of the loss, y'nu - sum phi*(nu) is one. The slopes of
// the loss at `c`, made smaller until they fit, are such a nu.
double ExplicitProblem::dual_bound(const VectorXd& look, const VectorXd& c) const {
  const double le = trivial_weight, mu = trivial_ridge, rho = mu / (1 + mu);
  const ArrayXd r = look - dictionary * c;
  VectorXd nu = rho * r + (1 - rho) * r.max(-le).min(le);
  const VectorXd slopes = dictionary.transpose() * nu;
  double scale = 1;
  for (Eigen::Index j = 0; j < slopes.size(); ++j)
    if (slopes(j) > weights(j)) scale = std::min(scale, weights(j) / slopes(j));
  nu *= scale;
  double bound = look.dot(nu);
  for (const double value : nu) {
    const double a = std::abs(value), inner = std::min(a, le), beyond = a - inner;
    bound -= inner * inner / 2;
    if (beyond > 1e-12) bound -= ((1 + mu) * beyond * (a + le) / 2 - le * beyond) / mu;
  }
  return bound;
}

}  // namespace relock
