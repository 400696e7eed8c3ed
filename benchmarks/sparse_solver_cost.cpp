// What the sparse solver of `blut` and `l1` (trackers/blut/sparse_solver.h) costs for a look, and how far it stays from
// the minimum. `gap`: mean of (objective - reference) / reference, in per cent; the reference is the same problem solved
// by a hundred times as many rounds without tolerance, in double (tests/trackers/sparse_reference.h).

#include <benchmark/benchmark.h>
#include "trackers/blut/sparse_solver.h"
#include "tests/trackers/shirt_looks.h"

namespace {
using namespace relock;
using blut::SolverOptions;

const Looks& looks() { static const Looks made = shirt_looks(400, 1); return made; }

void solve_cold(benchmark::State& state, int rounds, int sweeps) {
  const Looks& l = looks();
  blut::SparseSolver solver(l.dictionary, l.weights, {.rounds = rounds, .sweeps = sweeps});
  blut::SparseSolver exact(l.dictionary, l.weights, {.rounds = 4000, .sweeps = 10, .tolerance = 1e-8});
  static std::vector<float> best;
  if (best.empty()) for (Eigen::Index i = 0; i < l.looks.cols(); ++i) { blut::Solution s; exact.solve(l.looks.col(i), s); best.push_back(s.objective); }
  blut::Solution s;
  double gap = 0, kkt = 0, worst=0, support=0, inl=0;
  for (Eigen::Index i = 0; i < l.looks.cols(); ++i) { s.coefficients.resize(0); solver.solve(l.looks.col(i), s); double g = (s.objective - best[static_cast<std::size_t>(i)])/best[static_cast<std::size_t>(i)]; gap += g; worst = std::max(worst, g); kkt = std::max<double>(kkt, s.kkt_residual); support += (s.coefficients.array()>0).count(); inl += (solver.trivial(l.looks.col(i), s.coefficients).array()==0).count(); }
  const double n = static_cast<double>(l.looks.cols());
  state.counters["gap%"] = 100*gap/n; state.counters["worst%"] = 100*worst; state.counters["kkt"] = kkt; state.counters["support"] = support/n; state.counters["inliers"]=inl/n;
  Eigen::Index i = 0;
  for (auto _ : state) { s.coefficients.resize(0); solver.solve(l.looks.col(i), s); i = (i+1) % l.looks.cols(); }
}
BENCHMARK_CAPTURE(solve_cold, accurate, 30, 5);
BENCHMARK_CAPTURE(solve_cold, fast, 4, 3);
}
BENCHMARK_MAIN();
