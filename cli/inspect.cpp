// `relock inspect`: what a recording is and what it is fit for, before any run.

#include <fmt/format.h>

#include <opencv2/core/utility.hpp>

#include "cli/inspect/report.h"
#include "cli/recordings.h"
#include "cli/terminal.h"
#include "cli/verbs.h"
#include "core/error.h"
#include "eval/inspection/blur_estimate.h"
#include "sequences/time_faults.h"

namespace relock {
namespace {

constexpr std::size_t kShownFaults = 5;

/// Says all about times that do not rise, where opening stops at the first.
void check_times(const std::filesystem::path& file) {
  const auto faults = time_faults(file);
  if (faults.empty()) return;
  std::string list;
  for (std::size_t i = 0; i < std::min(faults.size(), kShownFaults); ++i)
    list += fmt::format(
        "{}line {} {}", i == 0 ? "" : ", ", faults[i].line,
        faults[i].time == faults[i].before
            ? "repeats"
            : fmt::format("goes back by {:.3f} ms", 1e3 * seconds(faults[i].before - faults[i].time)));
  if (faults.size() > kShownFaults) list += ", …";
  throw Error(
      fmt::format("{}: {} of the capture times do not rise ({}); they must, so remove or mend these rows",
                  file.string(), faults.size(), list));
}

/// Reads every picture once.
void estimate_blur(InspectReport& report) {
  const Recording& recording = report.sequence.recording;
  BlurReport& blur = report.blur.emplace();
  blur.targets.resize(recording.targets.size());
  const BlurEstimator estimator;
  Progress progress("blur", static_cast<std::int64_t>(recording.frames()));
  try {
    const auto source = report.sequence.frames();
    while (const auto stamp = source->next()) {
      const Image picture = source->image();
      blur.picture.push_back({stamp->index, estimator.estimate(picture), {}});
      for (std::size_t t = 0; t < recording.targets.size(); ++t) {
        const TargetTruth& truth = recording.truth_of(static_cast<std::size_t>(stamp->index), t);
        if (truth.label == Label::visible)
          blur.targets[t].push_back(
              {stamp->index, estimator.estimate(picture, bounds(*truth.outline)), truth.size_px()});
      }
      progress.done(stamp->index + 1);
    }
  } catch (const Error& fault) {
    report.pictures_fault = fault.what();
  }
}

}  // namespace

int inspect(const InspectArguments& arguments) {
  cv::setNumThreads(1);
  const auto path = recording_path(arguments.path);
  check_times(path / "timestamps.csv");
  InspectReport report;
  report.sequence =
      open_sequence(path, {arguments.labels, arguments.rate_hz, {}, arguments.format, arguments.topic});
  report.inspection = inspect(report.sequence.recording);
  if (!arguments.no_pictures) estimate_blur(report);
  fmt::print("{}", arguments.json ? inspect_json(report) : inspect_text(report));
  if (report.pictures_fault) throw Error(*report.pictures_fault);
  return 0;
}

}  // namespace relock
