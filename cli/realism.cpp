// `relock realism`: whether a simulated flight looks and moves like real footage, in numbers.

#include <fmt/format.h>

#include <cmath>
#include <opencv2/core/utility.hpp>

#include "cli/recordings.h"
#include "cli/table.h"
#include "cli/terminal.h"
#include "cli/verbs.h"
#include "core/error.h"
#include "eval/inspection/appearance.h"
#include "eval/inspection/blur_estimate.h"
#include "eval/inspection/inspection.h"
#include "sequences/open.h"

namespace relock {
namespace {

/// Largest ratio either way at which a simulated quantity still counts as near the real one.
constexpr double kNear = 2;
/// Noise is told apart no finer than this, grey levels: both are below what 8 bits and JPEG leave of it.
constexpr double kNoiseNear = 0.5;
/// Published steps of blurred benchmark targets, in D: the lowest and the highest of several sequences.
constexpr double kStepMedian[] = {0.11, 0.30}, kStepP95[] = {0.29, 0.72};

struct Measured {
  Appearance appearance;
  BlurSummary blur;
  std::optional<Spread> step_d;
};

Measured measure(const std::filesystem::path& path) {
  const Sequence sequence = open_sequence(recording_path(path));
  const Recording& recording = sequence.recording;
  const Inspection inspection = inspect(recording);
  AppearanceGatherer gatherer;
  const BlurEstimator estimator;
  std::vector<BlurOfFrame> blur;
  Progress progress(recording.name, static_cast<std::int64_t>(recording.frames()));
  const auto source = sequence.frames();
  while (const auto stamp = source->next()) {
    const Image picture = source->image();
    gatherer.add(picture);
    blur.push_back({stamp->index, estimator.estimate(picture), {}});
    progress.done(stamp->index + 1);
  }
  Measured measured{gatherer.result(), summarise(blur), {}};
  for (const TargetInspection& target : inspection.targets)
    if (target.step_d && !measured.step_d) measured.step_d = target.step_d;
  return measured;
}

std::string text(const std::optional<double>& value, const char* form = "{:.2f}") {
  return value ? fmt::format(fmt::runtime(form), *value) : "n/a";
}

/// The table, and how many of its quantities are far.
class Comparison {
 public:
  void add(const std::string& name, std::optional<double> simulated, std::optional<double> real,
           const char* form = "{:.2f}") {
    std::string verdict = "n/a";
    if (simulated && real && *simulated > 0 && *real > 0)
      verdict = judge(*simulated, *real / kNear, *real * kNear);
    table_.add({name, text(simulated, form), text(real, form), "", verdict});
  }
  void add_noise(const std::string& name, std::optional<double> simulated, std::optional<double> real) {
    if (!simulated && !real) return;
    std::string verdict = "n/a";
    if (simulated && real) verdict = judge(*simulated, *real - kNoiseNear, *real + kNoiseNear);
    table_.add({name, text(simulated), text(real), "", verdict});
  }
  /// What is shorter than can be told counts as just that.
  void add_blur(const std::string& name, std::optional<double> simulated, std::optional<double> real) {
    std::string verdict = "n/a";
    if (simulated && real) {
      const double length = std::max(*real, kLeastBlur_px);
      verdict = judge(std::max(*simulated, kLeastBlur_px), length / kNear, length * kNear);
    }
    table_.add({name, text(simulated, "{:.1f}"), text(real, "{:.1f}"), "", verdict});
  }
  /// Within the published range, widened by kNear at both ends.
  void add_published(const std::string& name, std::optional<double> simulated, std::optional<double> real,
                     const double (&range)[2]) {
    const std::string verdict = simulated ? judge(*simulated, range[0] / kNear, range[1] * kNear) : "n/a";
    table_.add(
        {name, text(simulated), text(real), fmt::format("{:.2f} to {:.2f}", range[0], range[1]), verdict});
  }
  std::string table() const { return table_.text(2); }
  int far() const { return far_; }

 private:
  std::string judge(double value, double least, double most) {
    if (value >= least && value <= most) return "near";
    ++far_;
    return "far";
  }
  Table table_{{"quantity", "simulated", "real", "published", ""}};
  int far_ = 0;
};

template <class T>
std::optional<double> of(const std::optional<T>& spread, double T::*member) {
  if (!spread) return {};
  return (*spread).*member;
}

Comparison compare(const Measured& a, const Measured& b) {
  Comparison all;
  all.add("gradient mean, levels/px", a.appearance.gradient_mean, b.appearance.gradient_mean);
  all.add("gradient p95", a.appearance.gradient_p95, b.appearance.gradient_p95);
  for (std::size_t i = 0; i < Appearance::kShades; ++i)
    all.add_noise(fmt::format("noise at grey {} to {}, levels", 32 * i, 32 * i + 31), a.appearance.noise[i],
                  b.appearance.noise[i]);
  all.add_blur("blur estimated, median px", of(a.blur.length_px, &Spread::median),
               of(b.blur.length_px, &Spread::median));
  all.add_blur("blur estimated, p95 px", of(a.blur.length_px, &Spread::p95),
               of(b.blur.length_px, &Spread::p95));
  all.add_published("step, median D", of(a.step_d, &Spread::median), of(b.step_d, &Spread::median),
                    kStepMedian);
  all.add_published("step, p95 D", of(a.step_d, &Spread::p95), of(b.step_d, &Spread::p95), kStepP95);
  return all;
}

}  // namespace

int realism(const RealismArguments& arguments) {
  cv::setNumThreads(1);
  const Comparison all = compare(measure(arguments.simulated), measure(arguments.real));
  fmt::print("{} beside {}\n\n{}\n", arguments.simulated.string(), arguments.real.string(), all.table());
  fmt::print(
      "  near: within a factor of {:g} of the real footage (noise: {:g} levels; blur under {:g} px counts as "
      "that);\n"
      "  steps: of the range of published benchmark targets.\n",
      kNear, kNoiseNear, kLeastBlur_px);
  fmt::print("  Blur and noise are estimates from the pictures (docs/simulating.md).\n");
  return all.far() == 0 ? 0 : 1;
}

}  // namespace relock
