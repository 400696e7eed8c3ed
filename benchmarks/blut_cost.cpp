// What `blut`, `l1` and `ivt` cost for a frame of 640 x 360 in colour, against the number of particles, with looks of
// 20 x 20 and 75 templates; the share that each stage has of a frame of `blut`; and a start. Google Benchmark's time
// is processor time: frames/s is for one core.
#include <benchmark/benchmark.h>

#include <map>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "core/opencv.h"
#include "tests/trackers/blurred_world.h"
#include "trackers/blut/templates.h"
#include "trackers/builtin.h"

namespace {

using namespace relock;

/// A flight with blur and jerks, all pictures drawn beforehand.
struct Film {
  BlurredPath path = blurred_path(60, 36, 5);
  std::vector<cv::Mat> pictures;
  static constexpr Vec2 kOffset{80, 20};  // of the world's picture in these

  Film() {
    const BlurredWorld world(5);
    for (std::size_t i = 0; i < path.centres.size(); ++i) {
      cv::Mat wide, colour;
      cv::copyMakeBorder(world.picture(path.centres[i], path.blurs[i]), wide, 20, 20, 80, 80,
                         cv::BORDER_REFLECT);
      cv::cvtColor(wide, colour, cv::COLOR_GRAY2BGR);
      pictures.push_back(colour);
    }
  }
  Box box() const { return BlurredWorld::box(path.centres[0] + kOffset); }
  Frame frame(std::size_t i) const {
    return {static_cast<FrameIndex>(i), time_ns(static_cast<std::int64_t>(i) * 1'000'000'000 / 30),
            view(pictures[i])};
  }
};

const Film& film() {
  static const Film one;
  return one;
}

std::unique_ptr<Tracker> make(const std::string& name, const std::map<std::string, std::string>& options) {
  static const auto registry = [] {
    Registry<TrackerEntry> all;
    add_builtin_trackers(all);
    return all;
  }();
  const TrackerEntry& entry = *registry.find(name);
  return entry.make(Options(name, entry.options, options), 1);
}

void frames(benchmark::State& state, const std::string& name, std::map<std::string, std::string> options) {
  options["particles"] = std::to_string(state.range(0));
  std::unique_ptr<Tracker> tracker;
  std::size_t i = film().pictures.size();
  for (auto _ : state) {
    if (i == film().pictures.size()) {
      state.PauseTiming();
      tracker = make(name, options);
      tracker->start(film().frame(0), film().box());
      i = 1;
      state.ResumeTiming();
    }
    benchmark::DoNotOptimize(tracker->track(film().frame(i++)));
  }
  state.counters["frames/s"] = benchmark::Counter(1, benchmark::Counter::kIsIterationInvariantRate);
}

void start(benchmark::State& state, const std::string& name) {
  for (auto _ : state) {
    const auto tracker = make(name, {});
    tracker->start(film().frame(0), film().box());
  }
}

/// The stages of a frame one by one, with 400 particles as they are in frame 20.
struct Stages {
  BlutOptions options;
  Random random{1};
  Vec2 size{BlurredWorld::kWidth, BlurredWorld::kHeight};
  particles::Sampling sampling{options.particles.grid, size};
  particles::State last{.centre = film().path.centres[0] + Film::kOffset};
  std::optional<blut::Templates> templates;
  std::optional<blut::SparseSolver> solver;
  std::vector<particles::State> particles;
  particles::Observations seen;

  Stages() {
    sampling.show(film().frame(0).image, 1);
    templates.emplace(sampling, last, size, options, random);
    solver.emplace(templates->looks(), templates->weights(options, {}), options.solver);
    last.centre = film().path.centres[19] + Film::kOffset;
    propose();
    sampling.show(film().frame(20).image, 1);
    sampling.observe(particles, seen);
  }
  void propose() {
    particles.assign(400, last);
    const particles::Motion motion{.last = last, .blur = film().path.blurs[19]};
    particles::propose(motion, {}, options.particles, options.proposal, size, particles, random);
  }
};

void stages(benchmark::State& state, void (*run)(Stages&)) {
  Stages all;
  for (auto _ : state) run(all);
}

void solve(Stages& s) {
  blut::Solution solution;
  for (Eigen::Index i = 0; i < s.seen.look.cols(); ++i) {
    solution.coefficients.setZero(s.solver->templates());
    s.solver->solve(s.seen.look.col(i), solution);
    benchmark::DoNotOptimize(solution.squared_residual);
  }
}

void add_benchmarks() {
  for (const auto& [label, name, options] :
       std::vector<std::tuple<std::string, std::string, std::map<std::string, std::string>>>{
           {"blut, accurate", "blut", {}},
           {"blut, accurate, no bound", "blut", {{"bound", "false"}}},
           {"blut, fast", "blut", {{"solver", "fast"}}},
           {"l1", "l1", {}},
           {"ivt", "ivt", {}}})
    benchmark::RegisterBenchmark(
        ("frame: " + label).c_str(),
        [name = name, options = options](benchmark::State& state) { frames(state, name, options); })
        ->Arg(200)
        ->Arg(400)
        ->Arg(600)
        ->Unit(benchmark::kMillisecond);
  const std::vector<std::pair<std::string, void (*)(Stages&)>> all{
      {"propose", [](Stages& s) { s.propose(); }},
      {"shrink the picture", [](Stages& s) { s.sampling.show(film().frame(20).image, 1); }},
      {"observe", [](Stages& s) { s.sampling.observe(s.particles, s.seen); }},
      {"bound",
       [](Stages& s) {
         Eigen::VectorXf bounds;
         s.solver->bound(s.seen.look, bounds);
       }},
      {"solve all", solve}};
  for (const auto& [label, run] : all)
    benchmark::RegisterBenchmark(("stage, 400 particles: " + label).c_str(), [run = run](
                                                                                 benchmark::State& state) {
      stages(state, run);
    })->Unit(benchmark::kMillisecond);
  for (const std::string name : {"blut", "l1", "ivt"})
    benchmark::RegisterBenchmark(("start: " + name).c_str(), [name](benchmark::State& state) {
      start(state, name);
    })->Unit(benchmark::kMillisecond);
}

}  // namespace

int main(int count, char** arguments) {
  cv::setNumThreads(1);
  add_benchmarks();
  benchmark::Initialize(&count, arguments);
  benchmark::RunSpecifiedBenchmarks();
}
