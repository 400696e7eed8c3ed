// Whether `blut`, `l1`, `ivt` and `kcf` hold a target without gaps, before anything is said of gaps: blur of 0 to 30
// px, steps of up to 0.45 widths, ten worlds (tests/trackers/blurred_world.h). Then what each part of `blut` adds,
// and how exactly the blur is told. The share of frames with the answer within 0.25 D of the truth is printed, and the
// time of a frame.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>
#include <numbers>
#include <opencv2/core/utility.hpp>
#include <string>

#include "core/opencv.h"
#include "tests/trackers/blurred_world.h"
#include "trackers/builtin.h"

namespace relock {
namespace {

constexpr int kSeeds = 10;

struct Kind {
  std::string label, name;
  std::map<std::string, std::string> options = {};
};

struct Run {
  double held = 0;  // share of frames
  std::vector<double> direction_errors_deg, length_errors;
  int sharp_frames = 0, sharp_called_blurred = 0, blurred_frames = 0, blurred_told = 0;
  double ms = 0;
};

double processor_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

void note_blur(Run& run, const Sighting& seen, const BlurEstimate& truth) {
  if (truth.length_px < 3) {
    ++run.sharp_frames;
    run.sharp_called_blurred += seen.blur.has_value();
  }
  if (truth.length_px < 0.15 * BlurredWorld::kWidth || truth.length_px > 0.4 * BlurredWorld::kWidth) return;
  ++run.blurred_frames;
  if (!seen.blur) return;
  ++run.blurred_told;
  const double apart = between_axes(seen.blur->direction_rad, truth.direction_rad);
  run.direction_errors_deg.push_back(apart * 180 / std::numbers::pi);
  run.length_errors.push_back(std::abs(seen.blur->length_px / truth.length_px - 1));
}

Run run(const Kind& kind, double fastest, int frames, std::uint64_t seed) {
  Registry<TrackerEntry> registry;
  add_builtin_trackers(registry);
  const TrackerEntry& entry = *registry.find(kind.name);
  const auto tracker = entry.make(Options(kind.name, entry.options, kind.options), seed);
  const BlurredWorld world(seed);
  const BlurredPath path = blurred_path(frames, fastest, seed);
  const auto frame = [&](const cv::Mat& pixels, int i) {
    return Frame{i, time_ns(i * 1'000'000'000LL / 30), view(pixels)};
  };
  const cv::Mat first = world.picture(path.centres[0]);
  tracker->start(frame(first, 0), BlurredWorld::box(path.centres[0]));
  Run result;
  const double gate = 0.25 * std::sqrt(BlurredWorld::kWidth * BlurredWorld::kHeight);
  for (int i = 1; i < frames; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const cv::Mat pixels = world.picture(path.centres[at], path.blurs[at]);
    const double begun = processor_ms();
    const auto seen = tracker->track(frame(pixels, i));
    result.ms += (processor_ms() - begun) / (frames - 1);
    if (!seen || norm(seen->centre - path.centres[at]) > gate) continue;
    result.held += 1.0 / (frames - 1);
    note_blur(result, *seen, path.blurs[at]);
  }
  return result;
}

double median(std::vector<double> values) {
  if (values.empty()) return std::nan("");
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

void print(const Kind& kind, double fastest, int frames) {
  Run all;
  std::string shares;
  int good = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Run one = run(kind, fastest, frames, seed);
    shares += fmt::format(" {:.2f}", one.held);
    good += one.held >= 0.95;
    all.ms += one.ms / kSeeds;
    all.direction_errors_deg.insert(all.direction_errors_deg.end(), one.direction_errors_deg.begin(),
                                    one.direction_errors_deg.end());
    all.length_errors.insert(all.length_errors.end(), one.length_errors.begin(), one.length_errors.end());
    all.sharp_frames += one.sharp_frames, all.sharp_called_blurred += one.sharp_called_blurred;
    all.blurred_frames += one.blurred_frames, all.blurred_told += one.blurred_told;
  }
  fmt::print("  {:26} {:2}/{} {} {:6.1f} ms", kind.label, good, kSeeds, shares, all.ms);
  if (!all.length_errors.empty())
    fmt::print("  blur told {}/{}, off by {:.1f} deg, {:.0f} %; sharp called blurred {}/{}", all.blurred_told,
               all.blurred_frames, median(all.direction_errors_deg), 100 * median(all.length_errors),
               all.sharp_called_blurred, all.sharp_frames);
  fmt::print("\n");
}

}  // namespace
}  // namespace relock

int main(int count, char** arguments) {
  using namespace relock;
  cv::setNumThreads(1);
  const int frames = count > 1 ? std::stoi(arguments[1]) : 200;
  const std::vector<Kind> kinds{{"blut", "blut"},
                                {"l1", "l1"},
                                {"ivt", "ivt"},
                                {"kcf", "kcf"},
                                {"blut, fast solver", "blut", {{"solver", "fast"}}},
                                {"blut, no bound", "blut", {{"bound", "false"}}},
                                {"blut, no blur templates", "blut", {{"blur_templates", "false"}}},
                                {"blut, no lobes", "blut", {{"blur_lobes", "false"}}},
                                {"blut, no update", "blut", {{"update", "false"}}},
                                {"blut, velocity", "blut", {{"velocity", "true"}}}};
  for (const double fastest : {6., 36.}) {
    fmt::print(
        "steps of up to {} px, blur of up to {:.0f} px, target of 80 px: worlds held in 95 % of frames, "
        "shares\n",
        fastest, fastest * 5 / 6);
    for (const Kind& kind : kinds) print(kind, fastest, frames);
  }
}
