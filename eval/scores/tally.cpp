#include "eval/scores/tally.h"

#include <algorithm>

#include "eval/judgement/visible_time.h"

namespace relock {
namespace {

std::size_t blur_bin(const std::optional<BlurVector>& blur) {
  if (!blur) return kBlurBinCount - 1;
  const auto at = std::lower_bound(kBlurBins_px.begin(), kBlurBins_px.end(), norm(*blur));
  return static_cast<std::size_t>(at - kBlurBins_px.begin());
}

std::size_t gap_bin(std::int64_t slots) {
  const auto at = std::lower_bound(kGapBins.begin(), kGapBins.end(), slots);
  return static_cast<std::size_t>(at - kGapBins.begin());
}

void count_sources(const Recording& recording, const std::string& method, std::size_t target,
                   const std::vector<Contribution>& frames, Tally& tally) {
  for (std::size_t frame = 0; frame < recording.frames(); ++frame) {
    const TargetTruth& truth = recording.truth_of(frame, target);
    if (truth.label != Label::unlabelled) ++tally.labels[to_string(truth.source)];
    if (stems_from(truth.source, method))
      tally.own_labels += static_cast<std::size_t>(frames[frame].could_hit);
  }
}

void count_verdicts(const TargetTimeline& timeline, Tally& tally) {
  for (const Judgement& judged : timeline.judgements) {
    ++tally.frames;
    ++tally.verdicts[static_cast<std::size_t>(judged.verdict)];
    tally.uncoded += judged.uncoded ? 1 : 0;
    tally.failed += judged.failed ? 1 : 0;
  }
}

template <std::size_t n>
void count_bins(const std::vector<Contribution>& frames, const std::vector<std::size_t>& bins,
                std::array<HitCount, n>& counts) {
  for (std::size_t frame = 0; frame < frames.size(); ++frame) {
    counts[bins[frame]].could_hit += static_cast<std::size_t>(frames[frame].could_hit);
    counts[bins[frame]].hits += static_cast<std::size_t>(frames[frame].hits);
  }
}

/// Adds one loss: an answer is in force from its frame to the next scored lost frame or the loss's end; the time
/// before the first lost frame and under isolated Hits is left out.
void add_lost_time(const Loss& loss, std::span<const VisibleInterval> visible, const TargetTimeline& timeline,
                   LostTime& lost) {
  const auto begin = static_cast<std::size_t>(loss.first_lost),
             end = static_cast<std::size_t>(loss.end_frame);
  auto at = std::lower_bound(visible.begin(), visible.end(), begin,
                             [](const VisibleInterval& v, std::size_t frame) { return v.frame < frame; });
  std::size_t looked_at = begin;
  Verdict in_force = Verdict::Miss;
  for (; at != visible.end() && at->frame < end; ++at) {
    for (; looked_at <= at->frame; ++looked_at)
      if (scored(timeline.judgements[looked_at].verdict)) in_force = timeline.judgements[looked_at].verdict;
    if (timeline.states[at->frame] != State::Lost || in_force == Verdict::Hit) continue;
    const Duration length = at->to - at->from;
    lost.told += length;
    if (in_force != Verdict::Miss) lost.answered += length;
  }
}

void add_losses(const Recording& recording, const TargetTimeline& timeline,
                std::span<const VisibleInterval> visible, Tally& tally) {
  for (const Loss& loss : timeline.losses) {
    tally.losses.push_back({seconds(loss_time(recording, loss)), loss.end == LossEnd::recovered});
    ++tally.losses_by_kind[static_cast<std::size_t>(loss.kind)];
    add_lost_time(loss, visible, timeline, tally.lost);
  }
}

std::vector<Time> hit_times(const Recording& recording, std::span<const Judgement> judgements) {
  std::vector<Time> hits;
  for (std::size_t frame = 0; frame < judgements.size(); ++frame)
    if (judgements[frame].verdict == Verdict::Hit) hits.push_back(recording.captured[frame]);
  return hits;
}

template <class T>
void append(std::vector<T>& all, const std::vector<T>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

template <std::size_t n>
void add(std::array<std::size_t, n>& all, const std::array<std::size_t, n>& more) {
  for (std::size_t i = 0; i < n; ++i) all[i] += more[i];
}

template <std::size_t n>
void add(std::array<HitCount, n>& all, const std::array<HitCount, n>& more) {
  for (std::size_t i = 0; i < n; ++i) {
    all[i].could_hit += more[i].could_hit;
    all[i].hits += more[i].hits;
  }
}

}  // namespace

std::vector<std::size_t> blur_bins(const Recording& recording, std::size_t target) {
  std::vector<std::size_t> bins;
  for (std::size_t frame = 0; frame < recording.frames(); ++frame)
    bins.push_back(blur_bin(recording.truth_of(frame, target).blur));
  return bins;
}

std::vector<std::size_t> gap_bins(const Recording& recording, std::span<const Judgement> judgements) {
  std::vector<std::size_t> bins;
  std::size_t last = 0;  // the last frame that was not Dropped
  for (std::size_t frame = 0; frame < recording.frames(); ++frame) {
    bins.push_back(gap_bin(slots(recording.captured[frame] - recording.captured[last], recording.period)));
    if (judgements[frame].verdict != Verdict::Dropped) last = frame;
  }
  return bins;
}

std::string_view blur_bin_name(std::size_t bin) {
  constexpr std::array<std::string_view, kBlurBinCount> names{
      "to 5 px", "5-10 px", "10-20 px", "20-40 px", "40-80 px", "over 80 px", "unknown"};
  return names[bin];
}

std::string_view gap_bin_name(std::size_t bin) {
  constexpr std::array<std::string_view, kGapBinCount> names{"1 slot", "2 slots", "3-4 slots", "5-8 slots",
                                                             "over 8 slots"};
  return names[bin];
}

Tally& Tally::operator+=(const Tally& other) {
  frames += other.frames;
  add(verdicts, other.verdicts);
  uncoded += other.uncoded;
  failed += other.failed;
  sum += other.sum;
  lost.told += other.lost.told;
  lost.answered += other.lost.answered;
  append(losses, other.losses);
  add(losses_by_kind, other.losses_by_kind);
  append(starts, other.starts);
  append(fixes, other.fixes);
  own_labels += other.own_labels;
  for (const auto& [source, count] : other.labels) labels[source] += count;
  append(ages, other.ages);
  add(by_blur, other.by_blur);
  add(by_gap, other.by_gap);
  spurious += other.spurious;
  ignored += other.ignored;
  recorded += other.recorded;
  frames_without_target += other.frames_without_target;
  sightings_without_target += other.sightings_without_target;
  return *this;
}

TargetTally tally(const Recording& recording, const Trajectory& trajectory, const Evaluation& evaluation,
                  std::size_t target) {
  const TargetTimeline& timeline = evaluation.targets[target];
  const auto visible = visible_time(recording, target, timeline.judgements);
  TargetTally result{contributions(recording, evaluation, target, visible), {}};
  Tally& all = result.tally;
  count_verdicts(timeline, all);
  count_sources(recording, trajectory.method, target, result.frames, all);
  count_bins(result.frames, blur_bins(recording, target), all.by_blur);
  count_bins(result.frames, gap_bins(recording, timeline.judgements), all.by_gap);
  for (const Contribution& frame : result.frames) all.sum += frame;
  add_losses(recording, timeline, visible, all);
  all.starts = tracking_lifetimes(recording, trajectory, timeline);
  all.fixes = fixes(recording, trajectory, evaluation, target);
  all.ages = fix_ages(visible, hit_times(recording, timeline.judgements));
  return result;
}

std::vector<TargetTally> tally_targets(const Recording& recording, const Trajectory& trajectory,
                                       const Evaluation& evaluation) {
  std::vector<TargetTally> all;
  for (std::size_t t = 0; t < recording.targets.size(); ++t)
    all.push_back(tally(recording, trajectory, evaluation, t));
  return all;
}

Tally tally_of_frames(const Recording& recording, const Evaluation& evaluation) {
  Tally result;
  result.recorded = recording.captured.back() - recording.captured.front() + recording.period;
  for (std::size_t frame = 0; frame < recording.frames(); ++frame) {
    result.spurious += static_cast<std::size_t>(evaluation.spurious[frame]);
    result.ignored += static_cast<std::size_t>(evaluation.ignored[frame]);
    std::size_t alarms = 0, rejects = 0;
    for (const TargetTimeline& timeline : evaluation.targets) {
      alarms += timeline.judgements[frame].verdict == Verdict::FalseAlarm ? 1 : 0;
      rejects += timeline.judgements[frame].verdict == Verdict::CorrectReject ? 1 : 0;
    }
    if (alarms + rejects < evaluation.targets.size()) continue;
    ++result.frames_without_target;
    result.sightings_without_target += alarms + static_cast<std::size_t>(evaluation.spurious[frame]);
  }
  result.sum.said = static_cast<std::int64_t>(result.spurious);
  return result;
}

Duration loss_time(const Recording& recording, const Loss& loss) {
  return recording.captured[static_cast<std::size_t>(loss.end_frame)] -
         recording.captured[static_cast<std::size_t>(loss.last_good)];
}

}  // namespace relock
