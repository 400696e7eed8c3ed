#include "eval/judgement/evaluation.h"

#include <fmt/format.h>

#include <cmath>

#include "core/error.h"

namespace relock {
namespace {

void check_fit(const Recording& recording, const Trajectory& trajectory) {
  if (trajectory.frames.size() != recording.frames())
    throw Error(
        fmt::format("the trajectory has {} frames and the recording {}; were they made for each other?",
                    trajectory.frames.size(), recording.frames()));
  if (trajectory.judged_from.size() != recording.targets.size() ||
      trajectory.failed_from.size() != recording.targets.size())
    throw Error(fmt::format("the trajectory is not of the recording's {} targets", recording.targets.size()));
  if (recording.period <= Duration::zero()) throw Error("the recording's nominal period must be above zero");
}

}  // namespace

Observation observation(const Recording& recording, std::size_t frame, std::size_t target,
                        const Judgement& judgement, const Sightings& sightings) {
  const TargetTruth& truth = recording.truth_of(frame, target);
  Observation seen{recording.captured[frame], truth.label, judgement.verdict, judgement.hold, {}, {}, 0};
  if (judgement.sighting >= 0 && truth.label == Label::visible) {
    const Sighting& sighting = sightings[static_cast<std::size_t>(judgement.sighting)];
    seen.reported = sighting.centre;
    seen.truth = truth.centre(sighting.centre_kind);
    seen.size_px = truth.size_px();
  }
  return seen;
}

Evaluation evaluate(const Recording& recording, const Trajectory& trajectory, const Gate& gate) {
  check_fit(recording, trajectory);
  const std::size_t targets = recording.targets.size();
  Evaluation result{gate, std::vector<TargetTimeline>(targets), {}, {}};
  std::vector<LockWatch> watches(targets, LockWatch(recording.period));
  for (std::size_t frame = 0; frame < recording.frames(); ++frame) {
    const FrameReport& report = trajectory.frames[frame];
    const FrameJudgement judged = judge_frame(recording, frame, report, trajectory, gate);
    result.spurious.push_back(judged.spurious);
    result.ignored.push_back(judged.ignored);
    for (std::size_t t = 0; t < targets; ++t) {
      result.targets[t].judgements.push_back(judged.targets[t]);
      watches[t].observe(observation(recording, frame, t, judged.targets[t], report.sightings));
    }
  }
  for (std::size_t t = 0; t < targets; ++t) {
    auto story = watches[t].finish();
    result.targets[t].states = std::move(story.states);
    result.targets[t].losses = std::move(story.losses);
    result.targets[t].acquisitions = std::move(story.acquisitions);
  }
  return result;
}

}  // namespace relock
