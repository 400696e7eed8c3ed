#include "eval/scores.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "eval/survival.h"
#include "eval/visible_time.h"

namespace relock {
namespace {

/// What scores are made of: counts and times that may be added up over targets.
struct Sums {
  std::size_t frames = 0;
  std::array<std::size_t, kVerdicts> verdicts{};
  std::size_t could_hit = 0;  // recognition's denominator
  std::size_t uncoded = 0, failed = 0, spurious = 0, ignored = 0;
  Duration visible{0}, locked{0}, lost{0}, fresh{0}, fresh_ceiling{0}, locked_ceiling{0};
  std::vector<Lifetime> losses;
  std::array<std::size_t, kLossKinds> losses_by_kind{};
  std::vector<Fix> fixes;
};

std::optional<double> share(double part, double whole) {
  if (whole <= 0) return {};
  return part / whole;
}

void count_verdicts(const Recording& recording, std::size_t target, const TargetTimeline& timeline,
                    Sums& sums) {
  for (std::size_t frame = 0; frame < timeline.judgements.size(); ++frame) {
    const Judgement& judged = timeline.judgements[frame];
    ++sums.frames;
    ++sums.verdicts[static_cast<std::size_t>(judged.verdict)];
    sums.uncoded += judged.uncoded ? 1 : 0;
    sums.failed += judged.failed ? 1 : 0;
    sums.could_hit += could_hit(recording.truth_of(frame, target), judged.verdict) ? 1 : 0;
  }
}

void add_up_times(const Recording& recording, std::size_t target, const TargetTimeline& timeline,
                  Sums& sums) {
  std::vector<Time> hits, possible_hits;
  for (std::size_t frame = 0; frame < timeline.judgements.size(); ++frame) {
    const Verdict verdict = timeline.judgements[frame].verdict;
    if (verdict == Verdict::Hit) hits.push_back(recording.captured[frame]);
    if (could_hit(recording.truth_of(frame, target), verdict))
      possible_hits.push_back(recording.captured[frame]);
  }
  const auto visible = visible_time(recording, target, timeline.judgements);
  for (const VisibleInterval& interval : visible) sums.visible += interval.to - interval.from;
  sums.locked += time_in(State::Locked, visible, timeline.states);
  sums.lost += time_in(State::Lost, visible, timeline.states);
  sums.fresh += fresh_time(visible, hits);
  sums.fresh_ceiling += fresh_time(visible, possible_hits);
  sums.locked_ceiling +=
      time_in(State::Locked, visible, perfect_states(recording, target, timeline.judgements));
}

void collect_losses(const Recording& recording, const TargetTimeline& timeline, Sums& sums) {
  for (const Loss& loss : timeline.losses) {
    sums.losses.push_back({seconds(loss_time(recording, loss)), loss.end == LossEnd::recovered});
    ++sums.losses_by_kind[static_cast<std::size_t>(loss.kind)];
  }
}

Sums sums_of(const Recording& recording, const Trajectory& trajectory, const Evaluation& evaluation,
             std::size_t target) {
  Sums sums;
  const TargetTimeline& timeline = evaluation.targets[target];
  count_verdicts(recording, target, timeline, sums);
  add_up_times(recording, target, timeline, sums);
  collect_losses(recording, timeline, sums);
  sums.fixes = fixes(recording, trajectory, evaluation, target);
  return sums;
}

void pool(Sums& all, const Sums& one) {
  all.frames += one.frames;
  for (std::size_t v = 0; v < kVerdicts; ++v) all.verdicts[v] += one.verdicts[v];
  for (std::size_t k = 0; k < kLossKinds; ++k) all.losses_by_kind[k] += one.losses_by_kind[k];
  all.could_hit += one.could_hit;
  all.uncoded += one.uncoded;
  all.failed += one.failed;
  all.visible += one.visible;
  all.locked += one.locked;
  all.lost += one.lost;
  all.fresh += one.fresh;
  all.fresh_ceiling += one.fresh_ceiling;
  all.locked_ceiling += one.locked_ceiling;
  all.losses.insert(all.losses.end(), one.losses.begin(), one.losses.end());
  all.fixes.insert(all.fixes.end(), one.fixes.begin(), one.fixes.end());
}

Recovery recovery_of(const std::vector<Lifetime>& losses) {
  const KaplanMeier unrecovered(losses);
  Recovery result;
  result.losses = losses.size();
  result.recovered = static_cast<std::size_t>(
      std::count_if(losses.begin(), losses.end(), [](const Lifetime& l) { return l.event; }));
  result.median_s = unrecovered.time_until(0.5);
  result.p90_s = unrecovered.time_until(0.1);
  result.follow_up_s = unrecovered.follow_up();
  if (losses.empty()) return result;
  for (std::size_t i = 0; i < kRecoveredWithin_s.size(); ++i)
    result.within[i] = unrecovered.probability_by(kRecoveredWithin_s[i]);
  return result;
}

/// Precision: Hits / all sightings that were judged; 0 when nothing was said but something was visible.
std::optional<double> precision_of(const Sums& sums) {
  const auto count = [&](Verdict v) { return sums.verdicts[static_cast<std::size_t>(v)]; };
  const std::size_t said = count(Verdict::Hit) + count(Verdict::Stray) + count(Verdict::WrongId) +
                           count(Verdict::FalseAlarm) + sums.spurious;
  if (said == 0) return sums.could_hit > 0 ? std::optional<double>(0.0) : std::nullopt;
  return static_cast<double>(count(Verdict::Hit)) / static_cast<double>(said);
}

Scores scores_of(const Sums& sums) {
  Scores s;
  s.frames = sums.frames;
  s.verdicts = sums.verdicts;
  s.uncoded = sums.uncoded;
  s.failed = sums.failed;
  s.spurious = sums.spurious;
  s.ignored = sums.ignored;
  const auto hits = static_cast<double>(sums.verdicts[static_cast<std::size_t>(Verdict::Hit)]);
  s.recognition = share(hits, static_cast<double>(sums.could_hit));
  s.precision = precision_of(sums);
  s.visible_s = seconds(sums.visible);
  s.locked_s = seconds(sums.locked);
  s.lost_s = seconds(sums.lost);
  s.searching_s = seconds(sums.visible - sums.locked - sums.lost);
  const auto of_visible = [&](Duration part) { return share(seconds(part), seconds(sums.visible)); };
  s.availability = of_visible(sums.fresh);
  s.availability_ceiling = of_visible(sums.fresh_ceiling);
  s.availability_of_ceiling = share(seconds(sums.fresh), seconds(sums.fresh_ceiling));
  s.locked_share = of_visible(sums.locked);
  s.locked_share_ceiling = of_visible(sums.locked_ceiling);
  s.locked_share_of_ceiling = share(seconds(sums.locked), seconds(sums.locked_ceiling));
  s.losses = sums.losses.size();
  s.losses_by_kind = sums.losses_by_kind;
  s.losses_per_minute = share(static_cast<double>(s.losses), s.locked_s / 60);
  if (s.losses > 0) s.mean_time_between_losses_s = s.locked_s / static_cast<double>(s.losses);
  s.recovery = recovery_of(sums.losses);
  s.localization = localize(sums.fixes, sums.could_hit);
  return s;
}

/// Every recorded frame has exactly one verdict for each target: asserted on every run.
void check_conservation(const Recording& recording, const Sums& sums) {
  const std::size_t counted = std::accumulate(sums.verdicts.begin(), sums.verdicts.end(), std::size_t{0});
  if (counted != recording.frames() * recording.targets.size())
    throw std::logic_error(fmt::format("{} verdicts on {} frames of {} targets", counted, recording.frames(),
                                       recording.targets.size()));
}

}  // namespace

Duration loss_time(const Recording& recording, const Loss& loss) {
  return recording.captured[static_cast<std::size_t>(loss.end_frame)] -
         recording.captured[static_cast<std::size_t>(loss.last_good)];
}

ScoreSheet score(const Recording& recording, const Trajectory& trajectory, const Evaluation& evaluation) {
  ScoreSheet sheet;
  Sums all;
  for (std::size_t t = 0; t < recording.targets.size(); ++t) {
    const Sums one = sums_of(recording, trajectory, evaluation, t);
    sheet.targets.push_back(scores_of(one));
    pool(all, one);
  }
  check_conservation(recording, all);
  for (const int n : evaluation.spurious) all.spurious += static_cast<std::size_t>(n);
  for (const int n : evaluation.ignored) all.ignored += static_cast<std::size_t>(n);
  sheet.pooled = scores_of(all);
  return sheet;
}

}  // namespace relock
