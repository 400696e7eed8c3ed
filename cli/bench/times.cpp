#include "cli/bench/times.h"

#include <fmt/format.h>

#include <ctime>

#include <algorithm>
#include <limits>

#include "core/opencv.h"

namespace relock::bench {
namespace {

constexpr int kRepeats = 3;  // the least disturbed of them counts

double thread_ms() {
  std::timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

double time_of(Detector& detector, const cv::Mat& pixels) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kRepeats; ++i) {
    const double begun = thread_ms();
    detector.detect(view(pixels));
    least = std::min(least, thread_ms() - begun);
  }
  return least;
}

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Measured ratio(const Bench& bench, Size picture, const Goal& goal) {
  simulator::StillPlan plan;
  plan.picture = picture;
  plan.blurs_px = {0, 15, 30, 60};
  const std::string what = fmt::format("time over aruco's, clutter of {}x{}", picture.width, picture.height);
  const PictureKind kind = stills(what, plan, bench.targets(), bench.settings().seeds);
  const std::size_t count = bench.count(16, 60);
  const auto ours = bench.make_detector(), theirs = bench.make_other("aruco");
  std::vector<double> our_ms, their_ms;
  for (std::size_t rank = 0; rank < count; ++rank) {
    const MadePicture made = kind.make(rank);
    our_ms.push_back(time_of(*ours, made.pixels)), their_ms.push_back(time_of(*theirs, made.pixels));
  }
  const double a = median_of(our_ms), b = median_of(their_ms);
  return {"time", what, "times", a / b, {}, count, goal, fmt::format("median {:.1f} ms and {:.1f} ms", a, b)};
}

}  // namespace

std::vector<Measured> measure_times(Bench& bench) {
  const auto at_most = [](double must, double aim) { return Goal{Goal::Sense::most, must, aim}; };
  return {ratio(bench, {640, 480}, at_most(1.5, 0.8)), ratio(bench, {1920, 1080}, at_most(1.5, 1.0))};
}

}  // namespace relock::bench
