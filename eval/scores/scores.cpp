#include "eval/scores/scores.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace relock {
namespace {

std::optional<double> share(double part, double whole) {
  if (whole <= 0) return {};
  return part / whole;
}

Recovery recovery_of(const std::vector<Lifetime>& losses) {
  const KaplanMeier unrecovered(losses);
  Recovery result;
  result.losses = losses.size();
  result.recovered = static_cast<std::size_t>(
      std::count_if(losses.begin(), losses.end(), [](const Lifetime& l) { return l.event; }));
  result.median_s = unrecovered.time_until(0.5);
  result.median_s_interval = unrecovered.time_until_interval(0.5);
  result.p90_s = unrecovered.time_until(0.1);
  result.follow_up_s = unrecovered.follow_up();
  if (losses.empty()) return result;
  for (std::size_t i = 0; i < kRecoveredWithin_s.size(); ++i)
    result.within[i] = unrecovered.probability_by(kRecoveredWithin_s[i]);
  return result;
}

/// Precision: Hits / all sightings that were judged; 0 when nothing was said but something was visible.
std::optional<double> precision_of(const Contribution& sum) {
  if (sum.said == 0) return sum.could_hit > 0 ? std::optional<double>(0.0) : std::nullopt;
  return static_cast<double>(sum.hits) / static_cast<double>(sum.said);
}

/// Harmonic mean of precision and recognition: 2 Hits / (sightings judged + frames that could be Hits).
std::optional<double> f1_of(const Contribution& sum) {
  return share(2 * static_cast<double>(sum.hits), static_cast<double>(sum.said + sum.could_hit));
}

void what_was_said(const Tally& tally, Scores& s) {
  const auto count = [&](Verdict v) {
    return static_cast<double>(tally.verdicts[static_cast<std::size_t>(v)]);
  };
  s.recognition = share(static_cast<double>(tally.sum.hits), static_cast<double>(tally.sum.could_hit));
  s.precision = precision_of(tally.sum);
  s.f1 = f1_of(tally.sum);
  s.wrong_identity_rate = share(count(Verdict::WrongId), count(Verdict::WrongId) + count(Verdict::Hit));
  s.false_alarms_per_1000 = share(1000 * static_cast<double>(tally.sightings_without_target),
                                  static_cast<double>(tally.frames_without_target));
  s.spurious_per_minute = share(60 * static_cast<double>(tally.spurious), seconds(tally.recorded));
}

void how_time_passed(const Tally& tally, Scores& s) {
  const Contribution& sum = tally.sum;
  s.visible_s = seconds(sum.visible);
  s.locked_s = seconds(sum.locked);
  s.lost_s = seconds(sum.lost);
  s.searching_s = seconds(sum.visible - sum.locked - sum.lost);
  const auto of_visible = [&](Duration part) { return share(seconds(part), seconds(sum.visible)); };
  s.availability = of_visible(sum.fresh);
  s.availability_ceiling = of_visible(sum.fresh_ceiling);
  s.availability_of_ceiling = share(seconds(sum.fresh), seconds(sum.fresh_ceiling));
  s.fix_age = fix_age(tally.ages);
  s.locked_share = of_visible(sum.locked);
  s.locked_share_ceiling = of_visible(sum.locked_ceiling);
  s.locked_share_of_ceiling = share(seconds(sum.locked), seconds(sum.locked_ceiling));
}

void what_was_lost(const Tally& tally, Scores& s) {
  s.losses = tally.losses.size();
  s.losses_by_kind = tally.losses_by_kind;
  s.losses_per_minute = share(static_cast<double>(s.losses), s.locked_s / 60);
  if (s.losses > 0) s.mean_time_between_losses_s = s.locked_s / static_cast<double>(s.losses);
  s.silent_share = share(seconds(tally.lost.answered), seconds(tally.lost.told));
  s.recovery = recovery_of(tally.losses);
  s.survival = tracking_survival(tally.starts);
}

/// Every recorded frame has exactly one verdict for each target: asserted on every run.
void check_conservation(const Recording& recording, const Tally& tally) {
  const std::size_t counted = std::accumulate(tally.verdicts.begin(), tally.verdicts.end(), std::size_t{0});
  if (counted != recording.frames() * recording.targets.size())
    throw std::logic_error(fmt::format("{} verdicts on {} frames of {} targets", counted, recording.frames(),
                                       recording.targets.size()));
}

}  // namespace

Scores scores_of(const Tally& tally) {
  Scores s;
  s.frames = tally.frames;
  s.verdicts = tally.verdicts;
  s.uncoded = tally.uncoded;
  s.failed = tally.failed;
  s.spurious = tally.spurious;
  s.ignored = tally.ignored;
  what_was_said(tally, s);
  how_time_passed(tally, s);
  what_was_lost(tally, s);
  s.localization = localize(tally.fixes, static_cast<std::size_t>(tally.sum.could_hit) - tally.own_labels);
  s.own_labels = tally.own_labels;
  s.labels = tally.labels;
  s.blur = blur_accuracy(tally.fixes);
  s.by_blur = tally.by_blur;
  s.by_gap = tally.by_gap;
  return s;
}

ScoreSheet score(const Recording& recording, const Trajectory& trajectory, const Evaluation& evaluation) {
  return score(recording, evaluation, tally_targets(recording, trajectory, evaluation));
}

ScoreSheet score(const Recording& recording, const Evaluation& evaluation,
                 std::span<const TargetTally> targets) {
  ScoreSheet sheet;
  Tally all;
  for (const TargetTally& one : targets) {
    sheet.targets.push_back(scores_of(one.tally));
    all += one.tally;
  }
  check_conservation(recording, all);
  all += tally_of_frames(recording, evaluation);
  sheet.pooled = scores_of(all);
  return sheet;
}

}  // namespace relock
