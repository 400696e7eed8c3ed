// What the sparse solver of `blut` and `l1` (trackers/blut/sparse_solver.h) costs for a look of 20 x 20, and
// how near it comes to the minimum: cold (from zero) and warm (from the look before), with the default limits
// ("accurate") and with 4 rounds of 3 steps ("fast"), against the number of templates; beside block
// coordinate descent, by which trackers of this kind are usually solved. Looks are patches of
// recordings/klahaag, as particles near (0.02 widths) and far (0.12 widths) from the target see them.
// Columns: gap_%, worst_% = (objective - reference) / reference, mean and largest over 400 looks, the
// reference being what duality allows at a solution of tolerance 1e-7; error = largest |difference| of ||y -
// D c||^2 from that solution; used = templates with a coefficient.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <functional>

#include "tests/trackers/shirt_looks.h"
#include "tests/trackers/sparse_reference.h"
#include "trackers/blut/sparse_solver.h"

namespace {

using namespace relock;
using blut::Solution, blut::SolverOptions, blut::SparseSolver;
using Eigen::Index, Eigen::MatrixXf, Eigen::VectorXf;

constexpr int kLooks = 400;
const SolverOptions kAccurate, kFast{.rounds = 4, .sweeps = 3}, kRidge{.trivial_ridge = 10};

/// 10 sharp templates, `directions` x 8 blurred ones and the first again.
Looks looks_of(std::int64_t directions, double spread) {
  return shirt_looks(kLooks, 1, static_cast<int>(directions), 8, spread);
}

using Solve = std::function<void(const VectorXf& look, Solution& solution)>;

/// Prints how far `solve` stays from the minimum.
void compare(benchmark::State& state, const Looks& looks, const SolverOptions& options, const Solve& solve) {
  const ExplicitProblem problem{looks.dictionary.cast<double>(), looks.weights.cast<double>(),
                                options.trivial_weight, options.trivial_ridge};
  SolverOptions exactly = options;
  exactly.rounds = 100;
  exactly.tolerance = 1e-7;
  SparseSolver exact(looks.dictionary, looks.weights, exactly);
  Solution solution, best;
  double sum = 0, worst = 0, error = 0;
  Index used = 0;
  for (Index i = 0; i < kLooks; ++i) {
    const VectorXf look = looks.looks.col(i);
    solve(look, solution);
    exact.solve(look, best);
    const double reference = problem.dual_bound(look.cast<double>(), best.coefficients.cast<double>());
    const double gap = solution.objective / reference - 1;
    sum += gap;
    worst = std::max(worst, gap);
    error = std::max<double>(error, std::abs(solution.squared_residual - best.squared_residual));
    used += (solution.coefficients.array() > 0).count();
  }
  state.counters["gap_%"] = 100 * sum / kLooks;
  state.counters["worst_%"] = 100 * worst;
  state.counters["error"] = error;
  state.counters["used"] = static_cast<double>(used) / kLooks;
  state.counters["templates"] = static_cast<double>(looks.dictionary.cols());
}

void run(benchmark::State& state, const Looks& looks, const SolverOptions& options, const Solve& solve) {
  compare(state, looks, options, solve);
  Solution solution;
  Index i = 0;
  VectorXf look;
  for (auto _ : state) {
    look = looks.looks.col(i);
    solve(look, solution);
    i = (i + 1) % kLooks;
  }
}

void cold(benchmark::State& state, double spread, const SolverOptions& options) {
  const Looks looks = looks_of(state.range(0), spread);
  SparseSolver solver(looks.dictionary, looks.weights, options);
  run(state, looks, options, [&](const VectorXf& look, Solution& solution) {
    solution.coefficients.setZero(solver.templates());
    solver.solve(look, solution);
  });
}

void warm(benchmark::State& state, double spread, const SolverOptions& options) {
  const Looks looks = looks_of(state.range(0), spread);
  SparseSolver solver(looks.dictionary, looks.weights, options);
  run(state, looks, options, [&](const VectorXf& look, Solution& solution) { solver.solve(look, solution); });
}

/// From zero: e by its closed form, then sweeps over all coefficients, each at its minimum, with D'D.
void coordinate_descent(benchmark::State& state, double spread, const SolverOptions& options) {
  const Looks looks = looks_of(state.range(0), spread);
  const MatrixXf gram = looks.dictionary.transpose() * looks.dictionary;
  const auto knee = static_cast<float>(options.trivial_weight);
  VectorXf gradient, e, residual;
  run(state, looks, options, [&](const VectorXf& look, Solution& solution) {
    VectorXf& c = solution.coefficients;
    c.setZero(gram.rows());
    for (int round = 0;; ++round) {
      residual = look;
      residual.noalias() -= looks.dictionary * c;
      e = residual.array() - residual.array().max(-knee).min(knee);
      if (round == options.rounds) break;
      gradient = looks.weights;
      gradient.noalias() -= looks.dictionary.transpose() * (residual - e);
      for (int sweep = 0; sweep < options.sweeps; ++sweep)
        for (Index j = 0; j < c.size(); ++j) {
          const float moved = std::max(0.F, c(j) - gradient(j) / gram(j, j)) - c(j);
          if (moved == 0) continue;
          c(j) += moved;
          gradient += moved * gram.col(j);
        }
    }
    solution.squared_residual = residual.squaredNorm();
    solution.objective = 0.5F * (residual - e).squaredNorm() + looks.weights.dot(c) + knee * e.lpNorm<1>();
  });
}

/// The error bound, for each look.
void bound(benchmark::State& state) {
  const Looks looks = looks_of(state.range(0), 0.12);
  const SparseSolver solver(looks.dictionary, looks.weights, {});
  VectorXf bounds;
  for (auto _ : state) solver.bound(looks.looks, bounds);
  state.counters["per_look"] =
      benchmark::Counter(kLooks, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// A template that is replaced.
void replace(benchmark::State& state) {
  const Looks looks = looks_of(state.range(0), 0.12);
  SparseSolver solver(looks.dictionary, looks.weights, {});
  for (auto _ : state) solver.replace(3, looks.looks.col(0));
}

void dictionaries(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgName("directions")->Unit(benchmark::kMicrosecond);
}
void few_to_many(benchmark::internal::Benchmark* benchmark) {
  dictionaries(benchmark);
  for (const int directions : {0, 2, 4, 8, 16}) benchmark->Arg(directions);
}
void as_in_blut(benchmark::internal::Benchmark* benchmark) {
  dictionaries(benchmark);
  benchmark->Arg(8);
}

BENCHMARK_CAPTURE(cold, far_accurate, 0.12, kAccurate)->Apply(few_to_many);
BENCHMARK_CAPTURE(cold, far_fast, 0.12, kFast)->Apply(as_in_blut);
BENCHMARK_CAPTURE(cold, far_ridge, 0.12, kRidge)->Apply(as_in_blut);
BENCHMARK_CAPTURE(warm, far_accurate, 0.12, kAccurate)->Apply(as_in_blut);
BENCHMARK_CAPTURE(warm, far_fast, 0.12, kFast)->Apply(as_in_blut);
BENCHMARK_CAPTURE(cold, near_accurate, 0.02, kAccurate)->Apply(as_in_blut);
BENCHMARK_CAPTURE(cold, near_fast, 0.02, kFast)->Apply(as_in_blut);
BENCHMARK_CAPTURE(cold, near_ridge, 0.02, kRidge)->Apply(as_in_blut);
BENCHMARK_CAPTURE(warm, near_accurate, 0.02, kAccurate)->Apply(as_in_blut);
BENCHMARK_CAPTURE(warm, near_fast, 0.02, kFast)->Apply(as_in_blut);
BENCHMARK_CAPTURE(coordinate_descent, far_30_rounds_of_5, 0.12, kAccurate)->Apply(as_in_blut);
BENCHMARK_CAPTURE(coordinate_descent, far_4_rounds_of_3, 0.12, kFast)->Apply(as_in_blut);
BENCHMARK_CAPTURE(coordinate_descent, near_30_rounds_of_5, 0.02, kAccurate)->Apply(as_in_blut);
BENCHMARK_CAPTURE(coordinate_descent, near_4_rounds_of_3, 0.02, kFast)->Apply(as_in_blut);
BENCHMARK(bound)->Apply(as_in_blut);
BENCHMARK(replace)->Apply(as_in_blut);

}  // namespace

BENCHMARK_MAIN();
