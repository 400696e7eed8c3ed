#include "eval/scores/contribution.h"

namespace relock {
namespace {

void add_counts(const Recording& recording, std::size_t target, std::span<const Judgement> judgements,
                std::vector<Contribution>& frames) {
  for (std::size_t frame = 0; frame < frames.size(); ++frame) {
    const Verdict verdict = judgements[frame].verdict;
    const bool said = verdict == Verdict::Hit || verdict == Verdict::Stray || verdict == Verdict::WrongId ||
                      verdict == Verdict::FalseAlarm;
    frames[frame].could_hit = could_hit(recording.truth_of(frame, target), verdict) ? 1 : 0;
    frames[frame].hits = verdict == Verdict::Hit ? 1 : 0;
    frames[frame].said = said ? 1 : 0;
  }
}

void add_times(const Recording& recording, std::size_t target, const TargetTimeline& timeline,
               std::span<const VisibleInterval> visible, std::vector<Contribution>& frames) {
  std::vector<Time> hits, possible_hits;
  for (std::size_t frame = 0; frame < frames.size(); ++frame) {
    if (frames[frame].hits > 0) hits.push_back(recording.captured[frame]);
    if (frames[frame].could_hit > 0) possible_hits.push_back(recording.captured[frame]);
  }
  const auto fresh = fresh_times(visible, hits), fresh_ceiling = fresh_times(visible, possible_hits);
  const auto perfect = perfect_states(recording, target, timeline.judgements);
  for (std::size_t i = 0; i < visible.size(); ++i) {
    const std::size_t frame = visible[i].frame;
    const Duration length = visible[i].to - visible[i].from;
    Contribution& part = frames[frame];
    part.visible = length;
    part.fresh = fresh[i];
    part.fresh_ceiling = fresh_ceiling[i];
    if (timeline.states[frame] == State::Locked) part.locked = length;
    if (timeline.states[frame] == State::Lost) part.lost = length;
    if (perfect[frame] == State::Locked) part.locked_ceiling = length;
  }
}

}  // namespace

Contribution& Contribution::operator+=(const Contribution& other) {
  could_hit += other.could_hit;
  hits += other.hits;
  said += other.said;
  visible += other.visible;
  fresh += other.fresh;
  fresh_ceiling += other.fresh_ceiling;
  locked += other.locked;
  locked_ceiling += other.locked_ceiling;
  lost += other.lost;
  return *this;
}

std::vector<Contribution> contributions(const Recording& recording, const Evaluation& evaluation,
                                        std::size_t target, std::span<const VisibleInterval> visible) {
  const TargetTimeline& timeline = evaluation.targets[target];
  std::vector<Contribution> frames(timeline.judgements.size());
  add_counts(recording, target, timeline.judgements, frames);
  add_times(recording, target, timeline, visible, frames);
  return frames;
}

std::vector<Contribution> contributions(const Recording& recording, const Evaluation& evaluation,
                                        std::size_t target) {
  return contributions(recording, evaluation, target,
                       visible_time(recording, target, evaluation.targets[target].judgements));
}

void add_spurious(std::vector<Contribution>& frames, const Evaluation& evaluation) {
  for (std::size_t frame = 0; frame < frames.size(); ++frame)
    frames[frame].said += evaluation.spurious[frame];
}

}  // namespace relock
