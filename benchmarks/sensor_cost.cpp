// What the simulator's sensor and its video link take for a picture of 640x360, on one thread.
#include <benchmark/benchmark.h>

#include <opencv2/core.hpp>

#include "core/random.h"
#include "sequences/simulator/sensor.h"
#include "sequences/simulator/transport.h"

namespace relock::simulator {
namespace {

cv::Mat some_light() {
  cv::Mat light(360, 640, CV_32FC3);
  Random random(1);
  for (int y = 0; y < light.rows; ++y)
    for (int i = 0; i < 3 * light.cols; ++i) light.ptr<float>(y)[i] = static_cast<float>(random.uniform());
  return light;
}

void developing(benchmark::State& state, const SensorPlan& plan) {
  cv::setNumThreads(1);
  const cv::Mat light = some_light();
  cv::Mat used_up, out;
  for (auto _ : state) {
    light.copyTo(used_up);
    develop(used_up, plan, 1.2, 1, out);
  }
}
BENCHMARK_CAPTURE(developing, usual, SensorPlan{})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(developing, sharpened, SensorPlan{.sharpening = 0.5})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(developing, far_out_of_focus, SensorPlan{.defocus_px = 2})->Unit(benchmark::kMillisecond);

void carrying(benchmark::State& state) {
  cv::Mat light = some_light(), picture, out;
  develop(light, {}, 1, 1, picture);
  VideoLink link({640, 360}, 30, 2000);
  for (auto _ : state) link.carry(picture, out);
}
BENCHMARK(carrying)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace relock::simulator

BENCHMARK_MAIN();
