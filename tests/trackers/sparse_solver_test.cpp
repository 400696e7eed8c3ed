#include "trackers/blut/sparse_solver.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <limits>

#include "core/error.h"
#include "core/random.h"
#include "tests/trackers/allocations.h"
#include "tests/trackers/shirt_looks.h"
#include "tests/trackers/sparse_reference.h"

namespace relock::blut {
namespace {

using Eigen::Index, Eigen::MatrixXf, Eigen::VectorXd, Eigen::VectorXf;

const Looks& shirt() {
  static const Looks made = shirt_looks(100, 1);
  return made;
}

const Looks& noise() {
  static const Looks made = random_looks(100, 2);
  return made;
}

/// L1-APG's setting without occlusion beside the default.
const SolverOptions kDefault, kRidge{.trivial_ridge = 10};

ExplicitProblem explicit_problem(const Looks& of, const SolverOptions& options) {
  return {of.dictionary.cast<double>(), of.weights.cast<double>(), options.trivial_weight,
          options.trivial_ridge};
}

SparseSolver solver_of(const Looks& looks, const SolverOptions& options = {}) {
  return {looks.dictionary, looks.weights, options};
}

/// From zero.
Solution solved(SparseSolver& solver, const VectorXf& look) {
  Solution solution;
  solver.solve(look, solution);
  return solution;
}

/// Does it for shirt and noise, the default and L1-APG's setting, and every look of them.
template <class Check>
void for_every_look(const SolverOptions& more, const Check& check) {
  for (const Looks* looks : {&shirt(), &noise()})
    for (const double ridge : {0.0, 10.0}) {
      SolverOptions options = more;
      options.trivial_ridge = ridge;
      SparseSolver solver = solver_of(*looks, options);
      const ExplicitProblem problem = explicit_problem(*looks, options);
      for (Index i = 0; i < looks->looks.cols(); ++i) {
        SCOPED_TRACE(fmt::format("{} {}, ridge {}", looks == &shirt() ? "shirt" : "noise", i, ridge));
        check(solver, problem, VectorXf(looks->looks.col(i)));
      }
    }
}

TEST(SparseSolver, TellsTheObjectiveOfTheProblemWithATrivialTemplateForEveryPixel) {
  for_every_look({}, [](SparseSolver& solver, const ExplicitProblem& problem, const VectorXf& look) {
    const Solution solution = solved(solver, look);
    const VectorXd c = solution.coefficients.cast<double>(),
                   e = solver.trivial(look, solution.coefficients).cast<double>();
    EXPECT_NEAR(solution.objective, problem.objective(look.cast<double>(), c, e), 1e-6);
    EXPECT_NEAR(solution.squared_residual, (look.cast<double>() - problem.dictionary * c).squaredNorm(),
                1e-6);
  });
}

TEST(SparseSolver, TakesLooksOfAnyNumberOfPixels) {
  for (const Index pixels : {1, 2, 3, 5, 13, 195}) {
    Looks looks = shirt();
    looks.dictionary = MatrixXf(shirt().dictionary.topRows(pixels)).colwise().normalized();
    const ExplicitProblem problem = explicit_problem(looks, kDefault);
    SparseSolver solver = solver_of(looks);
    for (Index i = 0; i < 10; ++i) {
      const VectorXf look = looks.looks.col(i).head(pixels).normalized();
      const Solution solution = solved(solver, look);
      const VectorXd y = look.cast<double>(), c = solution.coefficients.cast<double>();
      EXPECT_NEAR(solution.objective,
                  problem.objective(y, c, solver.trivial(look, c.cast<float>()).cast<double>()), 1e-6);
      EXPECT_LT(solution.objective, 1.01 * problem.interior_point(y));
    }
  }
}

TEST(SparseSolver, TellsTrivialCoefficientsThatNoChangeMakesBetter) {
  for (const SolverOptions& options : {kDefault, kRidge}) {
    const ExplicitProblem problem = explicit_problem(shirt(), options);
    SparseSolver solver = solver_of(shirt(), options);
    const VectorXf look = shirt().looks.col(3), c = solved(solver, look).coefficients;
    const VectorXd y = look.cast<double>(), cd = c.cast<double>();
    const VectorXd e = solver.trivial(look, c).cast<double>();
    for (Index i = 0; i < e.size(); ++i)
      for (const double change : {-1e-3, 1e-3}) {
        VectorXd other = e;
        other(i) += change;
        ASSERT_GT(problem.objective(y, cd, other), problem.objective(y, cd, e)) << i;
      }
  }
}

TEST(SparseSolver, ComesWithinAPerCentOfAnInteriorPointMethod) {
  for (const Looks* looks : {&shirt(), &noise()}) {
    const ExplicitProblem problem = explicit_problem(*looks, kDefault);
    SparseSolver solver = solver_of(*looks);
    for (Index i = 0; i < looks->looks.cols(); ++i) {
      const VectorXf look = looks->looks.col(i);
      const double reference = problem.interior_point(look.cast<double>());
      const double objective = solved(solver, look).objective;
      EXPECT_LT(objective, 1.01 * reference) << i;
      EXPECT_GT(objective, 0.999 * reference) << i;
    }
  }
}

TEST(SparseSolver, IsWithinAPerCentOfWhatDualityAllowsAndAThousandthInTheMean) {
  double sum = 0;
  int count = 0;
  for_every_look({}, [&](SparseSolver& solver, const ExplicitProblem& problem, const VectorXf& look) {
    const Solution solution = solved(solver, look);
    const double bound = problem.dual_bound(look.cast<double>(), solution.coefficients.cast<double>());
    EXPECT_LT(solution.objective, 1.01 * bound);
    EXPECT_GT(solution.objective, bound - 1e-6);
    sum += solution.objective / bound - 1;
    ++count;
  });
  EXPECT_LT(sum / count, 1e-3);
}

TEST(SparseSolver, GivesNoNegativeCoefficientsAndTellsTheKktResidualThatTheyHave) {
  for (const int rounds : {1, 2, 30})
    for_every_look({.rounds = rounds},
                   [](SparseSolver& solver, const ExplicitProblem& problem, const VectorXf& look) {
                     const Solution solution = solved(solver, look);
                     const VectorXd c = solution.coefficients.cast<double>(),
                                    e = solver.trivial(look, solution.coefficients).cast<double>(),
                                    left = look.cast<double>() - problem.dictionary * c - e,
                                    gradient = problem.weights - problem.dictionary.transpose() * left;
                     double worst = 0;
                     for (Index j = 0; j < c.size(); ++j)
                       worst = std::max(worst, c(j) > 0 ? std::abs(gradient(j)) : -gradient(j));
                     EXPECT_GE(c.minCoeff(), 0);
                     EXPECT_NEAR(solution.kkt_residual, worst, 2e-6);
                   });
}

TEST(SparseSolver, BringsTheKktResidualTowardsZeroWithRounds) {
  double before = 1;
  for (const int rounds : {1, 3, 30}) {
    double worst = 0;
    for_every_look({.rounds = rounds, .tolerance = 0},
                   [&](SparseSolver& solver, const ExplicitProblem&, const VectorXf& look) {
                     worst = std::max<double>(worst, solved(solver, look).kkt_residual);
                   });
    EXPECT_LT(worst, before);
    before = worst;
  }
  EXPECT_LT(before, 1e-6);
}

TEST(SparseSolver, FindsTheSameWhereverItStarts) {
  Random random(3);
  for (const Looks* looks : {&shirt(), &noise()}) {
    SparseSolver solver = solver_of(*looks);
    Solution warm;
    for (Index i = 0; i < looks->looks.cols(); ++i) {
      const VectorXf look = looks->looks.col(i);
      const Solution cold = solved(solver, look);
      solver.solve(look, warm);  // from the solution of the look before
      EXPECT_NEAR(warm.objective, cold.objective, 1e-3 * cold.objective);
      EXPECT_NEAR(warm.squared_residual, cold.squared_residual, 1e-2 * cold.squared_residual + 1e-4);
      Solution anywhere;
      anywhere.coefficients =
          VectorXf::NullaryExpr(solver.templates(), [&] { return static_cast<float>(random.normal()); });
      anywhere.coefficients(5) = std::numeric_limits<float>::quiet_NaN();
      anywhere.coefficients(6) = std::numeric_limits<float>::infinity();
      solver.solve(look, anywhere);
      EXPECT_NEAR(anywhere.objective, cold.objective, 1e-3 * cold.objective);
      EXPECT_GE(anywhere.coefficients.minCoeff(), 0);
    }
  }
}

TEST(SparseSolver, GivesTheSameForALookAloneAndAmongOthers) {
  for (const Looks* looks : {&shirt(), &noise()}) {
    SparseSolver solver = solver_of(*looks), other = solver_of(*looks);
    Solutions all;
    VectorXf bounds, bound;
    solver.solve(looks->looks, all);
    solver.bound(looks->looks, bounds);
    for (Index i = looks->looks.cols() - 1; i >= 0; --i) {
      const Solution alone = solved(other, looks->looks.col(i));
      other.bound(looks->looks.col(i), bound);
      EXPECT_EQ(alone.coefficients, all.coefficients.col(i));
      EXPECT_EQ(std::tuple(alone.objective, alone.squared_residual, alone.kkt_residual, bound(0)),
                std::tuple(all.objectives(i), all.squared_residuals(i), all.kkt_residuals(i), bounds(i)));
    }
  }
}

TEST(SparseSolver, TakesNoMemoryOnceItHasSolvedALook) {
  if (!allocations_are_counted()) GTEST_SKIP();
  SparseSolver solver = solver_of(noise());
  Solution solution = solved(solver, noise().looks.col(0));
  const std::size_t before = allocations();
  for (Index i = 0; i < noise().looks.cols(); ++i) {
    solution.coefficients.setZero();
    solver.solve(noise().looks.col(i), solution);
  }
  EXPECT_EQ(allocations(), before);
  EXPECT_GT((VectorXf::Ones(100) * solution.objective).eval().size(), 0);
  EXPECT_GT(allocations(), before) << "allocations are not seen at all";
}

TEST(SparseSolver, AfterATemplateIsReplacedIsLikeANewOne) {
  Looks looks = shirt();
  SparseSolver solver = solver_of(looks);
  const VectorXf look = looks.looks.col(60);
  looks.dictionary.col(4) = looks.looks.col(61);
  looks.weights(7) = 0.02F;
  solver.replace(4, looks.dictionary.col(4));
  solver.set_weights(looks.weights);
  SparseSolver fresh = solver_of(looks);
  VectorXf bound, fresh_bound;
  solver.bound(looks.looks, bound);
  fresh.bound(looks.looks, fresh_bound);
  EXPECT_EQ(solved(solver, look).coefficients, solved(fresh, look).coefficients);
  EXPECT_EQ(bound, fresh_bound);
}

TEST(SparseSolver, BoundsTheSquaredResidualFromBelow) {
  for (const Looks* looks : {&shirt(), &noise()})
    for (const SolverOptions& options : {kDefault, kRidge}) {
      SparseSolver solver = solver_of(*looks, options);
      Solutions solutions;
      VectorXf bounds;
      solver.solve(looks->looks, solutions);
      solver.bound(looks->looks, bounds);
      EXPECT_GE(bounds.minCoeff(), 0);
      EXPECT_GT(bounds.maxCoeff(), 0.01);
      EXPECT_LT((bounds - solutions.squared_residuals).maxCoeff(), 1e-5);
    }
}

TEST(SparseSolver, BoundsAMixtureOfTemplatesByNothingAndWhatIsAtRightAnglesByAll) {
  const MatrixXf dictionary = MatrixXf::Identity(10, 3);
  const SparseSolver solver(dictionary, VectorXf::Zero(3), {});
  MatrixXf looks = MatrixXf::Zero(10, 3);
  looks.col(0) << 0.6F, 0, -0.8F, 0, 0, 0, 0, 0, 0, 0;
  looks(7, 1) = 1;
  looks(1, 2) = 0.6F;
  looks(9, 2) = 0.8F;
  VectorXf bounds;
  solver.bound(looks, bounds);
  EXPECT_NEAR(bounds(0), 0, 1e-6);
  EXPECT_NEAR(bounds(1), 1, 1e-6);
  EXPECT_NEAR(bounds(2), 0.64, 1e-6);
}

TEST(SparseSolver, BoundsWellWhereTemplatesAreNearlyTheSame) {
  Looks looks = random_looks(40, 5, 12);
  looks.dictionary.col(1) = looks.dictionary.col(0);
  looks.dictionary.col(3) = (looks.dictionary.col(2) + 3e-5F * looks.looks.col(0)).normalized();
  looks.dictionary.col(5) = (looks.dictionary.col(3) + 1e-3F * looks.looks.col(1)).normalized();
  VectorXf bounds;
  solver_of(looks).bound(looks.looks, bounds);
  const auto factors = looks.dictionary.cast<double>().colPivHouseholderQr();
  const Eigen::MatrixXd q = Eigen::MatrixXd(factors.householderQ()).leftCols(11),
                        y = looks.looks.cast<double>();
  for (Index i = 0; i < y.cols(); ++i)
    EXPECT_NEAR(bounds(i), y.col(i).squaredNorm() - (q.transpose() * y.col(i)).squaredNorm(), 2e-6) << i;
}

TEST(SparseSolver, TakesFromATemplateSeenAloneItsWeight) {
  // All pixels are below the knee: 1/2 (1 - c)^2 + w c is smallest at 1 - w.
  SparseSolver solver(shirt().dictionary.leftCols(1), VectorXf::Constant(1, 0.03F), {.tolerance = 1e-7});
  const Solution solution = solved(solver, shirt().dictionary.col(0));
  EXPECT_NEAR(solution.coefficients(0), 0.97, 1e-5);
  EXPECT_NEAR(solution.squared_residual, 0.03 * 0.03, 1e-5);
}

TEST(SparseSolver, TellsAHiddenPartByTheTrivialTemplatesAndKeepsTheTemplate) {
  VectorXf look = shirt().dictionary.col(0);
  look.segment(100, 60).array() += 0.2F;
  SparseSolver solver(shirt().dictionary.leftCols(1), VectorXf::Zero(1), {});
  const Solution solution = solved(solver, look);
  EXPECT_NEAR(solution.coefficients(0), 1, 0.05);
  const VectorXf e = solver.trivial(look, solution.coefficients);
  EXPECT_NEAR(e.segment(100, 60).mean(), 0.19, 0.01);  // a knee less than what is hidden
  EXPECT_LT(e.head(100).cwiseAbs().maxCoeff(), 0.01);
  EXPECT_GT(solution.squared_residual, 2.2) << "what is hidden is not explained";
}

TEST(SparseSolver, DoesNotCareInWhatOrderTemplatesAndPixelsAre) {
  const SolverOptions exact{.tolerance = 1e-7};
  SparseSolver solver = solver_of(noise(), exact);
  const MatrixXf turned = noise().dictionary.reverse();
  SparseSolver reversed(turned, noise().weights.reverse(), exact);
  for (Index i = 0; i < 20; ++i) {
    const VectorXf there = solved(solver, noise().looks.col(i)).coefficients,
                   back = solved(reversed, noise().looks.col(i).reverse()).coefficients.reverse();
    EXPECT_LT((there - back).cwiseAbs().maxCoeff(), 1e-3) << i;
  }
}

TEST(SparseSolver, EndsWhereTemplatesAreTheSameManyOrFreeAndWhereLooksAreEmpty) {
  MatrixXf same = shirt().dictionary.leftCols(1).replicate(1, 9);
  const MatrixXf many = random_looks(50, 4).looks.topRows(13);
  for (const MatrixXf& dictionary : {same, MatrixXf(100 * same), many, MatrixXf(many.topRows(1))})
    for (const double knee : {0.0, 1e-6, 0.01, 1.0})
      for (const float weight : {0.F, 0.01F}) {
        SparseSolver solver(dictionary, VectorXf::Constant(dictionary.cols(), weight),
                            {.trivial_weight = knee, .tolerance = 1e-5});
        for (const float size : {0.F, 1e-6F, 1.F}) {
          const VectorXf look = size * shirt().looks.col(2).head(dictionary.rows());
          const Solution solution = solved(solver, look);
          EXPECT_TRUE(solution.coefficients.allFinite());
          EXPECT_GE(solution.coefficients.minCoeff(), 0);
          EXPECT_LT(solution.kkt_residual, 1e-4)
              << dictionary.cols() << " " << knee << " " << weight << " " << size;
        }
      }
}

TEST(SparseSolver, RefusesWhatIsNoProblem) {
  const MatrixXf dictionary = MatrixXf::Identity(6, 2);
  const VectorXf weights = VectorXf::Ones(2), nan = VectorXf::Constant(6, std::nanf(""));
  EXPECT_THROW(SparseSolver(MatrixXf(6, 0), VectorXf(), {}), Error);
  EXPECT_THROW(SparseSolver(nan, VectorXf::Ones(1), {}), Error);
  EXPECT_THROW(SparseSolver(dictionary, VectorXf::Ones(3), {}), Error);
  EXPECT_THROW(SparseSolver(dictionary, -weights, {}), Error);
  EXPECT_THROW(SparseSolver(dictionary, weights, {.trivial_weight = -1}), Error);
  EXPECT_THROW(SparseSolver(dictionary, weights, {.trivial_ridge = std::nan("")}), Error);
  EXPECT_THROW(SparseSolver(dictionary, weights, {.rounds = 0}), Error);
  SparseSolver solver(dictionary, weights, {});
  Solution solution;
  VectorXf bounds;
  EXPECT_THROW(solver.solve(VectorXf(VectorXf::Ones(7)), solution), Error);
  EXPECT_THROW(solver.solve(nan, solution), Error);
  EXPECT_THROW(solver.bound(MatrixXf::Ones(5, 1), bounds), Error);
  EXPECT_THROW(solver.replace(2, VectorXf::Ones(6)), Error);
  EXPECT_THROW(solver.replace(0, VectorXf::Ones(5)), Error);
  EXPECT_THROW(solver.trivial(VectorXf::Ones(6), VectorXf::Ones(3)), Error);
  EXPECT_THROW(solver.set_weights(VectorXf::Ones(1)), Error);
}

}  // namespace
}  // namespace relock::blut
