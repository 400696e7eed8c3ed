#pragma once

#include <Eigen/Core>
#include <vector>

#include "trackers/blut/newton_steps.h"

namespace relock::blut {

/// How a look is explained by templates, and how exactly.
struct SolverOptions {
  double trivial_weight = 0.01;  ///< le: weight of the trivial templates; the knee of Huber's loss
  double trivial_ridge = 0;      ///< mu: 0 in the original l1 tracker, 10 in L1-APG's mode without occlusion
  int rounds = 30;               ///< at most so many looks at all templates; few solutions need more than 6
  int sweeps = 5;                ///< at most so many Newton steps on the chosen templates in a round
  double tolerance = 1e-5;       ///< of the KKT residual, up to which a solution is good (0: none is)
};

/// Of one look.
struct Solution {
  Eigen::VectorXf coefficients;  ///< one for each template, none negative
  float objective = 0;           ///< of the problem below
  float squared_residual = 0;    ///< ||y - D c||^2: what trivial templates explain counts as not explained
  float kkt_residual = 0;        ///< largest slope along which the objective still falls; 0 at the minimum
};

/// Of many looks; element or column i belongs to look i.
struct Solutions {
  Eigen::MatrixXf coefficients;
  Eigen::VectorXf objectives, squared_residuals, kkt_residuals;
};

/// Explains looks by few templates and little else: non-negative sparse approximation with trivial templates.
///
/// Given are the dictionary D of n templates of d pixels (unit columns), a weight w_j >= 0 for each, and a
/// look y of unit length. Sought are coefficients c >= 0 and e, what no template explains (occlusion,
/// highlights), that minimise
///
///     1/2 ||y - D c - e||^2 + w'c + le ||e||_1 + mu/2 ||e||^2                                           (a)
///
/// The trivial templates +I and -I with coefficients e+, e- >= 0 are the same thing, e = e+ - e-: at the
/// minimum one of the two is 0, so that le (e+ + e-) = le |e|. With d = 400 and n = 75 that would be 875
/// unknowns. But for a given c, (a) falls into d problems of one unknown, by pixel, with r = y - D c: min
/// over e of 1/2 (r - e)^2 + le |e| + mu/2 e^2. Its derivative, e (1 + mu) - r + le sign(e), is 0 at
///
///     e(r) = sign(r) max(0, |r| - le) / (1 + mu)                                                       (b)
///
/// and what remains of (a) is
///
///     F(c) = sum over pixels of phi(r) + w'c,   phi(r) = 1/2 (r - e(r))^2 + le |e(r)| + mu/2 e(r)^2    (c)
///
/// a problem of n unknowns. By the envelope theorem phi'(r) = r - e(r): up to the knee |r| = le it is r,
/// beyond it r mu/(1 + mu) + sign(r) le/(1 + mu). For mu = 0 that is a constant and phi is Huber's loss. So F
/// is convex, piecewise quadratic, with gradient g = w - D' phi'(y - D c), and c >= 0 is a minimum exactly if
/// g_j = 0 where c_j > 0 and g_j >= 0 where c_j = 0 (Karush, Kuhn and Tucker). The largest violation of these
/// is the KKT residual.
///
/// Source: Mei and Ling, "Robust visual tracking and vehicle classification via sparse representation", PAMI
/// 2011 (mu = 0); Bao, Wu, Ling and Ji, "Real time robust L1 tracker using accelerated proximal gradient
/// approach", CVPR 2012 (mu > 0, bound); Wu, Ling, Yu, Li, Mei and Cheng, "Blurred target tracking by
/// blur-driven tracker", ICCV 2011 (weights by template).
///
/// How it is found. Few templates are used in a solution (3 of 75 is common), so a round looks at all
/// templates once, by their gradient, and then works with those in use and the four of steepest descent
/// alone: Newton's method on the quadratics that F is made of (newton_steps.h), which ends exactly where it
/// should. Coordinate descent, by which this is usually solved, needs ten times as long for a thousandth of
/// the accuracy, since blurred templates are nearly the same. A start near the solution saves little, and
/// fewer rounds and steps (4 and 3) save less: so solutions are accurate by default, and one need not depend
/// on the look before. benchmarks/sparse_solver_cost.cpp prints this.
///
/// One object serves one thread; it keeps buffers between calls, never answers.
class SparseSolver {
 public:
  /// Throws Error if there are no templates, if `weights` are not one for each, negative or not finite, or if
  /// an option is out of its range.
  SparseSolver(const Eigen::MatrixXf& dictionary, const Eigen::VectorXf& weights,
               const SolverOptions& options);

  /// Another template in place of the one in `column`.
  void replace(Eigen::Index column, const Eigen::Ref<const Eigen::VectorXf>& look);
  void set_weights(const Eigen::VectorXf& weights);

  Eigen::Index pixels() const { return pixels_; }
  Eigen::Index templates() const { return dictionary_.cols(); }

  /// A lower bound of the squared residual of any solution, for each look (a column): what the templates
  /// cannot explain with any coefficients, ||y||^2 - ||Q'y||^2, Q being an orthonormal basis of all of them.
  void bound(const Eigen::Ref<const Eigen::MatrixXf>& looks, Eigen::VectorXf& bounds) const;

  /// Starts from `solution.coefficients` if there is one for each template (those that are negative or not
  /// finite count as 0), else from zero. Where it starts changes how long it takes, and the answer within the
  /// tolerance.
  void solve(const Eigen::Ref<const Eigen::VectorXf>& look, Solution& solution);

  /// Of many looks (columns) at once. Starts from `solutions.coefficients` if there is a column for each.
  void solve(const Eigen::Ref<const Eigen::MatrixXf>& looks, Solutions& solutions);

  /// What no template explains, by (b).
  Eigen::VectorXf trivial(const Eigen::Ref<const Eigen::VectorXf>& look,
                          const Eigen::Ref<const Eigen::VectorXf>& coefficients) const;

 private:
  void check_size(Eigen::Index pixels) const;
  void find_basis();
  void start(const Eigen::Ref<const Eigen::VectorXf>& look, Eigen::VectorXf& coefficients);
  void find_gradient();
  void choose_templates(const Eigen::VectorXf& coefficients);

  SolverOptions options_;
  RobustLoss loss_;
  Eigen::Index pixels_;
  Eigen::MatrixXf dictionary_;
  Eigen::VectorXf weights_;
  Eigen::MatrixXf basis_;  // Q
  NewtonSteps steps_;

  // Of the look that is being solved.
  Eigen::ArrayXf residual_, slopes_;
  Eigen::VectorXf gradient_;
  std::vector<Eigen::Index> chosen_;
  Solution one_;
};

}  // namespace relock::blut
