#include "cli/report/timelines.h"

#include <algorithm>

#include "cli/loss_sentences.h"
#include "cli/report/encoded.h"
#include "eval/scores/scores.h"
#include "eval/timeline_text.h"

namespace relock::reports {
namespace {

/// Capture times from the first frame on, as [step in us, so many times].
Json times_json(const Recording& recording) {
  Json steps = Json::array();
  std::int64_t before = 0, last_step = -1, count = 0;
  const auto flush = [&] {
    if (count > 0) steps.push_back({last_step, count});
  };
  for (const Time& captured : recording.captured) {
    const std::int64_t now = (ns(captured) - ns(recording.captured.front()) + 500) / 1000,
                       step = now - before;
    if (step != last_step) flush(), last_step = step, count = 0;
    ++count;
    before = now;
  }
  flush();
  return steps;
}

std::string letters_of(const ScoredComparison& compared, std::size_t run, std::size_t target) {
  std::string letters;
  const Trajectory& said = compared.stored.runs[run].trajectory;
  const Target& of = compared.stored.recording.targets[target];
  const auto& judgements = compared.evaluations[run].targets[target].judgements;
  for (std::size_t frame = 0; frame < judgements.size(); ++frame) {
    const Verdict verdict = judgements[frame].verdict;
    letters += verdict == Verdict::Unlabelled && said_of(said.frames[frame], of) ? 'u' : letter(verdict);
  }
  return letters;
}

std::string errors_of(const TargetTimeline& timeline) {
  std::vector<std::optional<double>> errors;
  for (const Judgement& judgement : timeline.judgements)
    errors.push_back(std::isfinite(judgement.error_px) ? std::optional(judgement.error_px) : std::nullopt);
  return packed(errors);
}

Json loss_json(const ScoredComparison& compared, std::size_t run, std::size_t target, const Loss& loss) {
  const Recording& recording = compared.stored.recording;
  const LossSentences told = sentences_of(recording, compared.stored.runs[run].trajectory, target, loss);
  return {{"good", loss.last_good},
          {"lost", loss.first_lost},
          {"ended", loss.end_frame},
          {"end", to_string(loss.end)},
          {"kind", to_string(loss.kind)},
          {"what", told.what},
          {"target", told.target},
          {"said", told.said},
          {"lasted_s", rounded(seconds(loss_time(recording, loss)), 3)}};
}

Json lane_json(const ScoredComparison& compared, std::size_t run, std::size_t target) {
  const StoredRun& stored = compared.stored.runs[run];
  const TargetTimeline& timeline = compared.evaluations[run].targets[target];
  Json losses = Json::array();
  for (const Loss& loss : timeline.losses) losses.push_back(loss_json(compared, run, target, loss));
  return {{"run", run},
          {"method", stored.record.method},
          {"yardstick", stored.record.yardstick},
          {"verdicts", run_lengths(letters_of(compared, run, target))},
          {"errors", errors_of(timeline)},
          {"losses", losses},
          {"story", story(compared.stored.recording, stored.trajectory, compared.evaluations[run], target)}};
}

template <class Value>
std::vector<std::optional<double>> of_each_frame(const Recording& recording, std::size_t target,
                                                 Value value) {
  std::vector<std::optional<double>> all;
  for (std::size_t frame = 0; frame < recording.frames(); ++frame)
    all.push_back(value(recording.truth_of(frame, target)));
  return all;
}

std::optional<double> blur_px(const TargetTruth& truth) {
  return truth.blur ? std::optional(norm(*truth.blur)) : std::nullopt;
}
std::optional<double> size_px(const TargetTruth& truth) {
  return truth.outline ? std::optional(truth.size_px()) : std::nullopt;
}

bool any(const std::vector<std::optional<double>>& values) {
  return std::any_of(values.begin(), values.end(), [](const auto& value) { return value.has_value(); });
}

/// Whether more than half of the frames have no label: then what methods say of each other is told, too.
bool hardly_labelled(const Recording& recording, std::size_t target) {
  std::size_t labelled = 0;
  for (std::size_t frame = 0; frame < recording.frames(); ++frame)
    labelled += recording.truth_of(frame, target).label != Label::unlabelled ? 1 : 0;
  return 2 * labelled < recording.frames();
}

Json target_json(const ScoredComparison& compared, std::size_t t) {
  const Recording& recording = compared.stored.recording;
  const Target& target = recording.targets[t];
  Json lanes = Json::array();
  for (std::size_t run = 0; run < compared.stored.runs.size(); ++run)
    if (compared.stored.runs[run].trajectory.judged_from[t]) lanes.push_back(lane_json(compared, run, t));
  const auto blur = of_each_frame(recording, t, blur_px);
  return {{"id", target.id},
          {"code", target.code ? Json(to_string(*target.code)) : Json()},
          {"blur", any(blur) ? Json(packed(blur)) : Json()},
          {"size", packed(of_each_frame(recording, t, size_px))},
          {"agreement", hardly_labelled(recording, t) ? Json(packed(agreement(compared.stored, t))) : Json()},
          {"lanes", lanes}};
}

}  // namespace

const Sighting* said_of(const FrameReport& report, const Target& target) {
  const auto first = [&](auto of_target) -> const Sighting* {
    const auto found = std::find_if(report.sightings.begin(), report.sightings.end(), of_target);
    return found != report.sightings.end() ? &*found : nullptr;
  };
  if (const auto* tracked = first([&](const Sighting& s) { return s.track == target.id; })) return tracked;
  if (target.code)
    if (const auto* read = first([&](const Sighting& s) { return s.code == target.code; })) return read;
  return first([&](const Sighting& s) { return !s.track && !s.code; });
}

std::vector<std::optional<double>> agreement(const StoredComparison& comparison, std::size_t target) {
  std::vector<std::optional<double>> all;
  for (std::size_t frame = 0; frame < comparison.recording.frames(); ++frame) {
    std::vector<const Sighting*> said;
    for (const StoredRun& run : comparison.runs)
      if (!run.record.yardstick)
        if (const Sighting* place =
                said_of(run.trajectory.frames[frame], comparison.recording.targets[target]))
          said.push_back(place);
    std::size_t pairs = 0, agree = 0;
    for (std::size_t a = 0; a < said.size(); ++a)
      for (std::size_t b = a + 1; b < said.size(); ++b) {
        const double size = std::max(size_of(said[a]->outline), size_of(said[b]->outline));
        ++pairs, agree += norm(said[a]->centre - said[b]->centre) <= 0.5 * size ? 1 : 0;
      }
    all.push_back(pairs > 0 ? std::optional(static_cast<double>(agree) / static_cast<double>(pairs))
                            : std::nullopt);
  }
  return all;
}

Json timelines_json(const ScoredComparison& compared) {
  const Recording& recording = compared.stored.recording;
  const RunRecord& record = compared.stored.runs.front().record;
  std::string dropped;
  for (const FrameReport& report : compared.stored.runs.front().trajectory.frames)
    dropped += report.delivery == Delivery::dropped ? '.' : 'd';
  Json targets = Json::array();
  for (std::size_t t = 0; t < recording.targets.size(); ++t) targets.push_back(target_json(compared, t));
  const auto end = end_of_recording(compared.stored);
  return {{"heading", heading(compared.stored, compared.gate)},
          {"name", recording.name},
          {"gaps", record.gaps},
          {"picture", {recording.picture.width, recording.picture.height}},
          {"period_us", (recording.period.count() + 500) / 1000},
          {"times", times_json(recording)},
          {"delivery", run_lengths(dropped)},
          {"end", end ? Json(*end) : Json()},
          {"targets", targets}};
}

}  // namespace relock::reports
