// What scoring costs against the length of a recording: the complexity that Google Benchmark fits should be
// N.

#include <benchmark/benchmark.h>

#include "core/random.h"
#include "eval/scores/scores.h"

namespace {

using namespace relock;

struct Case {
  Recording recording;
  Trajectory trajectory;
};

/// One target that wanders, and a method that is off, silent or blind for a while now and then.
Case flight(std::int64_t frames) {
  Case made;
  Random random(1);
  made.recording.period = period_of(30);
  made.recording.picture = {640, 360};
  made.recording.targets = {{"target"}};
  made.trajectory.judged_from = {0};
  made.trajectory.failed_from = {std::nullopt};
  for (std::int64_t i = 0; i < frames; ++i) {
    made.recording.captured.push_back(Time{i * made.recording.period});
    const Box box{300 + 100 * random.uniform(), 150, 40, 40};
    TargetTruth truth;
    truth.label = Label::visible;
    truth.outline = box;
    made.recording.truth.push_back(truth);
    FrameReport report;
    if (i % 100 < 80) report.sightings = {sighting_of(box)};
    made.trajectory.frames.push_back(report);
  }
  return made;
}

void evaluate_and_score(benchmark::State& state) {
  const Case made = flight(state.range(0));
  for (auto _ : state)
    benchmark::DoNotOptimize(
        score(made.recording, made.trajectory, evaluate(made.recording, made.trajectory)));
  state.SetComplexityN(state.range(0));
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(evaluate_and_score)
    ->RangeMultiplier(4)
    ->Range(1000, 256000)
    ->Complexity()
    ->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
