#include "eval/judgement/visible_time.h"

#include <algorithm>

#include "eval/definitions.h"

namespace relock {

std::vector<VisibleInterval> visible_time(const Recording& recording, std::size_t target,
                                          std::span<const Judgement> judgements) {
  std::vector<VisibleInterval> intervals;
  std::optional<std::size_t> last;  // the last labelled frame
  bool unlabelled_between = false, pause_between = false;
  for (std::size_t frame = 0; frame < recording.frames(); ++frame) {
    const Label label = recording.truth_of(frame, target).label;
    if (frame > 0 && recording.captured[frame] - recording.captured[frame - 1] > kPause) pause_between = true;
    if (label == Label::unlabelled) {
      unlabelled_between = true;
      continue;
    }
    if (last && label == Label::visible && recording.truth_of(*last, target).label == Label::visible) {
      const Time from = recording.captured[*last], to = recording.captured[frame];
      const Verdict verdict = judgements[*last].verdict;
      const bool judged = verdict != Verdict::NotStarted && verdict != Verdict::Given;
      if (judged && !pause_between && (to - from <= kLabelsStop || !unlabelled_between))
        intervals.push_back({*last, from, to});
    }
    last = frame;
    unlabelled_between = pause_between = false;
  }
  return intervals;
}

std::vector<Duration> fresh_times(std::span<const VisibleInterval> visible, std::span<const Time> fixes) {
  std::vector<Duration> fresh(visible.size(), Duration{0});
  std::size_t first = 0;
  for (std::size_t i = 0; i < fixes.size(); ++i) {
    const Time until =
        i + 1 < fixes.size() ? std::min(fixes[i] + kFreshFix, fixes[i + 1]) : fixes[i] + kFreshFix;
    while (first < visible.size() && visible[first].to <= fixes[i]) ++first;
    for (std::size_t at = first; at < visible.size() && visible[at].from < until; ++at)
      fresh[at] += std::min(visible[at].to, until) - std::max(visible[at].from, fixes[i]);
  }
  return fresh;
}

bool could_hit(const TargetTruth& truth, Verdict verdict) {
  return truth.label == Label::visible && verdict != Verdict::NotStarted && verdict != Verdict::Given &&
         verdict != Verdict::Dropped;
}

std::vector<State> perfect_states(const Recording& recording, std::size_t target,
                                  std::span<const Judgement> judgements) {
  LockWatch watch(recording.period);
  for (std::size_t frame = 0; frame < recording.frames(); ++frame) {
    const TargetTruth& truth = recording.truth_of(frame, target);
    Observation seen{recording.captured[frame], truth.label, judgements[frame].verdict, false, {}, {}, 0};
    if (could_hit(truth, seen.verdict)) {
      seen.verdict = Verdict::Hit;
      seen.hold = true;
    } else if (seen.verdict == Verdict::FalseAlarm ||
               (seen.verdict == Verdict::Skipped && truth.label == Label::absent)) {
      seen.verdict = Verdict::CorrectReject;
    }
    watch.observe(seen);
  }
  return watch.finish().states;
}

}  // namespace relock
