#include "tests/eval/naive_evaluator.h"

#include "core/error.h"
#include "tests/eval/naive_parts.h"

namespace relock::naive {

using std::size_t;

// The last frame before k of a kind; nothing when there is none.
std::optional<size_t> last_before(const Looks& looks, size_t k, bool (*is)(const Look&)) {
  while (k-- > 0)
    if (is(looks[k])) return k;
  return {};
}
bool is_labelled(const Look& look) { return look.label != Label::unlabelled; }

bool unlabelled_between(const Looks& looks, size_t j, size_t k) {
  for (size_t i = j + 1; i < k; ++i)
    if (!is_labelled(looks[i])) return true;
  return false;
}

bool pause_between(const Looks& looks, size_t j, size_t k) {
  for (size_t i = j; i < k; ++i)
    if (looks[i + 1].captured - looks[i].captured > std::chrono::seconds(5)) return true;
  return false;
}

Looks looks_of(const Recording& recording, const Trajectory& trajectory, std::size_t target,
               const std::vector<Judgement>& judgements) {
  Looks looks;
  for (size_t k = 0; k < recording.captured.size(); ++k) {
    const TargetTruth& truth = recording.truth[k * recording.targets.size() + target];
    const Judgement& judgement = judgements[k];
    Look look{recording.captured[k], truth.label, judgement.verdict, judgement.hold, {}, {}, 0};
    if (judgement.sighting >= 0 && truth.label == Label::visible) {
      const Sighting& sighting = trajectory.frames[k].sightings[static_cast<size_t>(judgement.sighting)];
      look.reported = sighting.centre;
      look.truth = matching_centre(truth, sighting.centre_kind);
      look.size = outline_size(*truth.outline);
    }
    looks.push_back(look);
  }
  return looks;
}

Evaluation evaluate(const Recording& recording, const Trajectory& trajectory, const Gate& gate) {
  const size_t frames = recording.captured.size(), targets = recording.targets.size();
  if (trajectory.frames.size() != frames || trajectory.judged_from.size() != targets ||
      trajectory.failed_from.size() != targets)
    throw Error("the trajectory does not fit the recording");
  Evaluation evaluation;
  evaluation.gate = gate;
  evaluation.targets.resize(targets);
  for (size_t k = 0; k < frames; ++k) {
    const FrameJudgement frame = judge(recording, k, trajectory, gate);
    evaluation.spurious.push_back(frame.spurious);
    evaluation.ignored.push_back(frame.ignored);
    for (size_t t = 0; t < targets; ++t) evaluation.targets[t].judgements.push_back(frame.targets[t]);
  }
  for (size_t t = 0; t < targets; ++t) {
    TargetTimeline& timeline = evaluation.targets[t];
    const Story story = story_of(looks_of(recording, trajectory, t, timeline.judgements), recording.period);
    timeline.states = story.states;
    timeline.losses = story.losses;
    timeline.acquisitions = story.acquisitions;
  }
  return evaluation;
}

}  // namespace relock::naive
