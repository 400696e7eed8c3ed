// Figures 13 and 14 of the paper: BLUT above the ring's detector, on the same frames.

#include "cli/reproduce/gap_strips.h"

#include <fmt/format.h>

#include <algorithm>

#include <opencv2/core/mat.hpp>

#include "cli/drawing.h"
#include "cli/reproduce/contenders.h"
#include "cli/reproduce/gap_flights.h"
#include "cli/reproduce/pictures.h"
#include "core/opencv.h"
#include "eval/judgement/circumstances.h"

namespace relock::reproduction {
namespace {

constexpr FrameIndex kFrames = 5, kBeforeTheLoss = 1;
const std::string kTracker = "blut";

/// One method's run, and what became of each frame.
struct Row {
  const ScoredComparison* runs;
  std::size_t run = 0;
};

Row row_of(const ScoredComparison& runs, const std::string& method) {
  const auto& all = runs.stored.runs;
  const auto found =
      std::ranges::find_if(all, [&](const StoredRun& run) { return run.record.method == method; });
  return {&runs, static_cast<std::size_t>(found - all.begin())};
}

const Judgement& judgement(const Row& row, FrameIndex frame) {
  return row.runs->evaluations[row.run].targets.front().judgements[static_cast<std::size_t>(frame)];
}

/// How far the target goes from the frame before.
double step_px(const Recording& recording, FrameIndex frame) {
  const TargetTruth& now = recording.truth_of(static_cast<std::size_t>(frame), 0);
  const TargetTruth& before = recording.truth_of(static_cast<std::size_t>(frame) - 1, 0);
  return now.outline && before.outline ? norm(centre_of(*now.outline) - centre_of(*before.outline)) : 0;
}

const char* in_words(const Judgement& judged) {
  if (judged.verdict == Verdict::Given) return "given";
  if (judged.verdict == Verdict::Hit) return "on target";
  if (judged.verdict == Verdict::Miss) return "says nothing";
  if (judged.verdict == Verdict::WrongId) return "another code";
  return judged.hold ? "near" : "elsewhere";
}

std::string caption(const Row& row, const std::string& method, FrameIndex frame) {
  const std::string said = fmt::format("{}: {}", method, in_words(judgement(row, frame)));
  if (frame == 0) return said;
  const StoredComparison& stored = row.runs->stored;
  const Circumstances came = circumstances(stored.recording, stored.runs[row.run].trajectory, 0, frame);
  return fmt::format("{}; +{:.0f} ms, {:.2f} D", said,
                     1e3 * static_cast<double>(came.slots) * seconds(stored.recording.period),
                     came.displacement_d.value_or(0));
}

std::vector<cv::Mat> pictures_at(const std::filesystem::path& folder, const std::vector<FrameIndex>& frames) {
  const auto source = open_sequence(folder).frames();
  std::vector<cv::Mat> pictures;
  while (const auto stamp = source->next())
    if (std::ranges::find(frames, stamp->index) != frames.end())
      pictures.push_back(read_only_mat(source->image()).clone());
  return pictures;
}

cv::Mat strip(const std::filesystem::path& folder, const std::vector<FrameIndex>& frames,
              const std::vector<std::pair<std::string, Row>>& rows) {
  const std::vector<cv::Mat> pictures = pictures_at(folder, frames);
  std::vector<cv::Mat> all;
  for (const auto& [method, row] : rows)
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const auto& report =
          row.runs->stored.runs[row.run].trajectory.frames[static_cast<std::size_t>(frames[i])];
      all.push_back(captioned(drawn(pictures[i], report.sightings), caption(row, method, frames[i])));
    }
  return in_rows(all, static_cast<int>(frames.size()));
}

std::string told(const Row& tracker, const StripFrames& shown) {
  const Evaluation& evaluation = tracker.runs->evaluations[tracker.run];
  if (!shown.loss)
    return fmt::format(
        "{} does not lose the ring on this flight; the frames are those about the longest step.", kTracker);
  const Recording& recording = tracker.runs->stored.recording;
  const Loss& loss = evaluation.targets.front().losses.front();
  const Circumstances at =
      circumstances(recording, tracker.runs->stored.runs[tracker.run].trajectory, 0, loss);
  return fmt::format(
      "The frames are those about {}'s first loss, over {} of the camera's periods and {:.2f} D; {}.",
      kTracker, at.slots, at.displacement_d.value_or(0),
      loss.end == LossEnd::recovered ? "it finds the ring again later" : "it does not find the ring again");
}

std::string found_by(const Row& ring, const std::vector<FrameIndex>& frames, const std::string& method) {
  std::size_t hits = 0;
  for (const FrameIndex frame : frames) hits += judgement(ring, frame).verdict == Verdict::Hit ? 1 : 0;
  return fmt::format("{} finds it on {} of the {} frames.", method, hits, frames.size());
}

std::vector<Finding> figure(const Settings& settings, const Methods& methods, const std::string& id,
                            std::uint64_t seed) {
  std::vector<GapFlight> flights = gap_flights(settings);
  std::erase_if(flights, [&](const GapFlight& flight) { return flight.seed != seed || !flight.blurred; });
  const std::filesystem::path folder = fly_and_cut(settings, flights, {GapArm::gaps}).front().folder;
  const std::string detector = own_ring_method().method;
  const auto tracked = run_on(settings, {folder}, {kTracker}, Protocol::once, methods);
  const auto detected = run_on(settings, {folder}, {detector}, Protocol::detect, methods);
  const Row top = row_of(tracked.front(), kTracker), bottom = row_of(detected.front(), detector);
  const StripFrames shown =
      strip_frames(tracked.front().stored.recording, top.runs->evaluations[top.run].targets.front());
  Finding finding;
  finding.id = id;
  finding.title = fmt::format("a ring {}, {} above {} on the same frames",
                              ring_codes()[(seed - 1) % ring_codes().size()], kTracker, detector);
  finding.sentences = {told(top, shown), found_by(bottom, shown.frames, detector)};
  finding.pictures = {
      write_figure(settings, id, strip(folder, shown.frames, {{kTracker, top}, {detector, bottom}}))};
  finding.figures = {{"flight", folder_name(folder)}, {"frames", shown.frames}, {"loss", shown.loss}};
  return {finding};
}

}  // namespace

StripFrames strip_frames(const Recording& recording, const TargetTimeline& timeline) {
  FrameIndex last_good = 0;
  double farthest = -1;
  const bool loss = !timeline.losses.empty();
  if (loss) {
    last_good = timeline.losses.front().last_good;
  } else {
    for (FrameIndex frame = 1; frame < static_cast<FrameIndex>(recording.frames()); ++frame)
      if (const double step = step_px(recording, frame); step > farthest)
        farthest = step, last_good = frame - 1;
  }
  StripFrames shown{.frames = {}, .loss = loss};
  const FrameIndex first = std::max<FrameIndex>(0, last_good - kBeforeTheLoss);
  for (FrameIndex frame = first; frame < first + kFrames; ++frame)
    if (frame < static_cast<FrameIndex>(recording.frames())) shown.frames.push_back(frame);
  return shown;
}

std::vector<Finding> figure_13(const Settings& settings, const Methods& methods) {
  return figure(settings, methods, "figure-13", 1);
}

std::vector<Finding> figure_14(const Settings& settings, const Methods& methods) {
  return figure(settings, methods, "figure-14", 2);
}

}  // namespace relock::reproduction
