#include <algorithm>
#include <cctype>
#include <cmath>

#include "tests/eval/naive_evaluator.h"
#include "tests/eval/naive_parts.h"

namespace relock::naive {
namespace {

using std::size_t;
using Numbers = std::vector<double>;
using Share = std::optional<double>;

double in_seconds(Duration d) { return static_cast<double>(d.count()) * 1e-9; }
// n/a when there is nothing to share.
Share ratio(double part, double whole) { return whole > 0 ? Share(part / whole) : Share(); }
Share ratio(size_t part, size_t whole) {
  return ratio(static_cast<double>(part), static_cast<double>(whole));
}
Share ratio(const Share& part, const Share& whole) { return part && whole ? ratio(*part, *whole) : Share(); }

// --- Time.

// An interval between consecutive labelled frames counts when both are visible and it is at most 0.5 s or
// holds no unlabelled frame; not over a pause; those that begin at a NotStarted or Given frame are left out.
std::vector<Interval> visible_intervals(const Looks& looks) {
  std::vector<Interval> intervals;
  for (size_t j = 0; j < looks.size(); ++j)
    for (size_t k = j + 1; k < looks.size(); ++k) {
      if (!is_labelled(looks[j])) break;
      if (!is_labelled(looks[k])) continue;  // not the next labelled one
      const bool both = looks[j].label == Label::visible && looks[k].label == Label::visible;
      const bool close = looks[k].captured - looks[j].captured <= std::chrono::milliseconds(500);
      const bool left_out = looks[j].verdict == Verdict::NotStarted || looks[j].verdict == Verdict::Given;
      if (both && (close || !unlabelled_between(looks, j, k)) && !pause_between(looks, j, k) && !left_out)
        intervals.push_back({j, looks[j].captured, looks[k].captured});
      break;
    }
  return intervals;
}

Duration total(const std::vector<Interval>& intervals) {
  Duration sum{0};
  for (const Interval& each : intervals) sum += each.to - each.from;
  return sum;
}

// Between consecutive Hits dt apart min(dt, 0.1 s) is credited, as far as it lies in visible time.
Duration available(const std::vector<Interval>& visible, const std::vector<Time>& hits) {
  Duration sum{0};
  for (size_t i = 0; i < hits.size(); ++i) {
    Time until = hits[i] + std::chrono::milliseconds(100);
    if (i + 1 < hits.size()) until = std::min(until, hits[i + 1]);
    for (const Interval& each : visible) sum += common(hits[i], until, each.from, each.to);
  }
  return sum;
}

Duration spent_in(State state, const std::vector<Interval>& visible, const std::vector<State>& states) {
  Duration sum{0};
  for (const Interval& each : visible)
    if (states[each.frame] == state) sum += each.to - each.from;
  return sum;
}

// Visible frames that are not NotStarted, Given or Dropped: the denominator of recognition.
bool counts_for_recognition(const Look& look) {
  return look.label == Label::visible && look.verdict != Verdict::NotStarted &&
         look.verdict != Verdict::Given && look.verdict != Verdict::Dropped;
}

// The perfect method on the same frames: Hits on all of those, and nothing said of what is absent.
Looks perfected(Looks looks) {
  for (Look& look : looks) {
    if (look.verdict == Verdict::NotStarted || look.verdict == Verdict::Given ||
        look.verdict == Verdict::Dropped)
      continue;
    if (look.label == Label::visible) look.verdict = Verdict::Hit;
    if (look.label == Label::absent) look.verdict = Verdict::CorrectReject;
    look.hold = look.label == Label::visible;
  }
  return looks;
}

// --- Localization.

struct HitAt {
  double px, size, sigma;
  Vec2 error;  // reported - true
  std::optional<Vec2> blur;
  std::optional<BlurEstimate> told;
};

Share mean(const Numbers& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return ratio(sum, static_cast<double>(values.size()));
}
Share rms(Numbers values) {
  for (double& v : values) v *= v;
  const Share square = mean(values);
  return square ? Share(std::sqrt(*square)) : Share();
}
// Linear-interpolated between the order statistics (type 7).
Share percentile(Numbers values, double percent) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const double rank = percent / 100 * static_cast<double>(values.size() - 1);
  const auto below = static_cast<size_t>(std::floor(rank));
  const size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (rank - std::floor(rank)) * (values[above] - values[below]);
}
Numbers each(const std::vector<HitAt>& hits, auto value) {
  Numbers values;
  for (const HitAt& hit : hits) values.push_back(value(hit));
  return values;
}

Localization localization_of(const std::vector<HitAt>& hits, size_t frames_to_recognise) {
  Localization result;
  result.hits = hits.size();
  const Numbers px = each(hits, [](const HitAt& h) { return h.px; });
  const Numbers percent = each(hits, [](const HitAt& h) { return 100 * h.px / h.size; });
  result.mean_px = mean(px), result.mean_percent = mean(percent);
  result.rms_px = rms(px), result.rms_percent = rms(percent);
  result.median_px = percentile(px, 50), result.median_percent = percentile(percent, 50);
  result.p95_px = percentile(px, 95), result.p95_percent = percentile(percent, 95);
  if (!hits.empty()) {
    const Vec2 bias{*mean(each(hits, [](const HitAt& h) { return h.error.x; })),
                    *mean(each(hits, [](const HitAt& h) { return h.error.y; }))};
    result.bias_px = bias;
    result.spread_px = rms(each(hits, [&](const HitAt& h) { return distance(h.error, bias); }));
  }
  Numbers along, across;
  for (const HitAt& hit : hits) {
    if (!hit.blur || distance(*hit.blur, {}) == 0) continue;
    const double length = distance(*hit.blur, {});
    along.push_back(times(hit.error, *hit.blur) / length);
    across.push_back(times(hit.error, {-hit.blur->y, hit.blur->x}) / length);
  }
  result.along_blur_px = rms(along);
  result.across_blur_px = rms(across);
  const Numbers sigmas = each(hits, [](const HitAt& h) { return h.sigma; });
  if (std::any_of(sigmas.begin(), sigmas.end(), [](double s) { return s > 0; }))
    result.label_sigma_px = rms(sigmas);
  const std::array<double, 4> limits{.02, .05, .1, .25};
  for (size_t i = 0; i < limits.size(); ++i) {
    const auto count =
        std::count_if(hits.begin(), hits.end(), [&](const HitAt& h) { return h.px <= limits[i] * h.size; });
    result.within[i] = ratio(static_cast<size_t>(count), frames_to_recognise);
  }
  return result;
}

// Blurred from .1 D on, sharp up to .05 D. The angle between two lines is told by trying all of their senses.
BlurAccuracy blur_accuracy_of(const std::vector<HitAt>& hits) {
  BlurAccuracy result;
  Numbers degrees, percent;
  for (const HitAt& hit : hits) {
    if (!hit.blur) continue;
    const double length = distance(*hit.blur, {}), part = length / hit.size;
    if (part <= 0.05) ++result.sharp;
    if (part <= 0.05 && hit.told && hit.told->length_px > 0.1 * hit.size) ++result.sharp_blurred;
    if (part < 0.1) continue;
    ++result.blurred;
    if (!hit.told) continue;
    ++result.told;
    double least = 360;
    const double to = std::atan2(hit.blur->y, hit.blur->x) * 180 / M_PI;
    for (const double turned : {-360., -180., 0., 180., 360.})
      least = std::min(least, std::abs(hit.told->direction_rad * 180 / M_PI + turned - to));
    degrees.push_back(least);
    percent.push_back(100 * std::abs(hit.told->length_px / length - 1));
  }
  result.direction_median_deg = percentile(degrees, 50), result.direction_p95_deg = percentile(degrees, 95);
  result.length_median_percent = percentile(percent, 50), result.length_p95_percent = percentile(percent, 95);
  return result;
}

// --- Everything that is pooled by adding up or by putting together.

struct Heap {
  Scores counts;                           // only its counts, numbers of losses and bins are filled in
  size_t to_recognise = 0, by_others = 0;  // of them: the method did not make the label
  Duration visible{0}, locked{0}, lost{0}, fresh{0}, fresh_at_best{0}, locked_at_best{0};
  std::vector<Watched> losses;
  std::vector<HitAt> hits;
  std::vector<Ageing> ageings;
  LostTime said_while_lost;
};

// Whether one of the names that a method is typed with is among those that made a label.
bool made_by(const std::string& method, const LabelSource& source) {
  std::string word;
  for (const char c : method + ",") {
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_') {
      word += c;
      continue;
    }
    for (const std::string& name : source.detectors)
      if (name == word) return true;
    word.clear();
  }
  return false;
}

void add_target(Heap& heap, const Recording& recording, const Trajectory& trajectory, size_t t,
                const TargetTimeline& timeline) {
  const Looks looks = looks_of(recording, trajectory, t, timeline.judgements);
  const Looks perfect = perfected(looks);
  const auto visible = visible_intervals(looks);
  std::vector<Time> hits, possible_hits;
  for (size_t k = 0; k < looks.size(); ++k) {
    const Judgement& judgement = timeline.judgements[k];
    ++heap.counts.frames;
    ++heap.counts.verdicts[static_cast<size_t>(judgement.verdict)];
    heap.counts.uncoded += judgement.uncoded ? 1 : 0;
    heap.counts.failed += judgement.failed ? 1 : 0;
    const TargetTruth& truth = recording.truth[k * recording.targets.size() + t];
    const bool own = made_by(trajectory.method, truth.source);
    if (is_labelled(looks[k])) ++heap.counts.labels[to_string(truth.source)];
    if (counts_for_recognition(looks[k])) {
      (own ? heap.counts.own_labels : heap.by_others) += 1;
      const size_t hit = judgement.verdict == Verdict::Hit ? 1 : 0;
      HitCount& blur = heap.counts.by_blur[blur_bin(recording.truth[k * recording.targets.size() + t])];
      HitCount& gap = heap.counts.by_gap[gap_bin(looks, k, recording.period)];
      ++heap.to_recognise, ++blur.could_hit, ++gap.could_hit;
      blur.hits += hit, gap.hits += hit;
    }
    if (perfect[k].verdict == Verdict::Hit) possible_hits.push_back(looks[k].captured);
    if (judgement.verdict != Verdict::Hit) continue;
    hits.push_back(looks[k].captured);
    if (own) continue;  // it would be measured by itself
    const Vec2 error{looks[k].reported.x - looks[k].truth.x, looks[k].reported.y - looks[k].truth.y};
    const auto sighting = static_cast<size_t>(judgement.sighting);
    heap.hits.push_back({judgement.error_px, outline_size(*truth.outline), truth.sigma_px, error, truth.blur,
                         trajectory.frames[k].sightings[sighting].blur});
  }
  heap.visible += total(visible);
  heap.locked += spent_in(State::Locked, visible, timeline.states);
  heap.lost += spent_in(State::Lost, visible, timeline.states);
  heap.fresh += available(visible, hits);
  heap.fresh_at_best += available(visible, possible_hits);
  heap.locked_at_best += spent_in(State::Locked, visible, story_of(perfect, recording.period).states);
  for (const Ageing& each : ageings(visible, hits)) heap.ageings.push_back(each);
  const LostTime lost = lost_time_of(looks, timeline, visible);
  heap.said_while_lost.told += lost.told, heap.said_while_lost.answered += lost.answered;
  for (const Loss& loss : timeline.losses) {
    const Duration time = looks[static_cast<size_t>(loss.end_frame)].captured -
                          looks[static_cast<size_t>(loss.last_good)].captured;
    heap.losses.push_back({time, loss.end == LossEnd::recovered});
    ++heap.counts.losses;
    ++heap.counts.losses_by_kind[static_cast<size_t>(loss.kind)];
  }
}

Scores scores_of(const Heap& heap) {
  Scores s = heap.counts;
  const auto count = [&](Verdict v) { return s.verdicts[static_cast<size_t>(v)]; };
  const size_t hits = count(Verdict::Hit);
  const size_t said =
      hits + count(Verdict::Stray) + count(Verdict::WrongId) + count(Verdict::FalseAlarm) + s.spurious;
  s.recognition = ratio(hits, heap.to_recognise);
  s.precision = ratio(hits, said);
  if (said == 0 && heap.to_recognise > 0) s.precision = 0;  // nothing said but something was visible
  if (heap.to_recognise > 0 || said > 0) s.f1 = hits > 0 ? 2 / (1 / *s.recognition + 1 / *s.precision) : 0;
  s.wrong_identity_rate = ratio(count(Verdict::WrongId), count(Verdict::WrongId) + hits);
  s.visible_s = in_seconds(heap.visible);
  s.locked_s = in_seconds(heap.locked);
  s.lost_s = in_seconds(heap.lost);
  s.searching_s = in_seconds(heap.visible - heap.locked - heap.lost);
  s.availability = ratio(in_seconds(heap.fresh), s.visible_s);
  s.availability_ceiling = ratio(in_seconds(heap.fresh_at_best), s.visible_s);
  s.availability_of_ceiling = ratio(s.availability, s.availability_ceiling);
  s.fix_age = fix_age_of(heap.ageings);
  s.silent_share = ratio(in_seconds(heap.said_while_lost.answered), in_seconds(heap.said_while_lost.told));
  s.locked_share = ratio(s.locked_s, s.visible_s);
  s.locked_share_ceiling = ratio(in_seconds(heap.locked_at_best), s.visible_s);
  s.locked_share_of_ceiling = ratio(s.locked_share, s.locked_share_ceiling);
  s.losses_per_minute = ratio(static_cast<double>(s.losses), s.locked_s / 60);
  s.mean_time_between_losses_s = ratio(s.locked_s, static_cast<double>(s.losses));
  s.recovery = recovery_of(heap.losses);
  s.localization = localization_of(heap.hits, heap.by_others);
  s.blur = blur_accuracy_of(heap.hits);
  return s;
}

// Sightings, claimed or not, per 1000 frames whose every verdict is FalseAlarm or CorrectReject.
Share false_alarms_per_1000(const Trajectory& trajectory, const Evaluation& evaluation) {
  size_t frames = 0, sightings = 0;
  for (size_t k = 0; k < trajectory.frames.size(); ++k) {
    bool without_target = true;
    for (const TargetTimeline& target : evaluation.targets) {
      const Verdict verdict = target.judgements[k].verdict;
      if (verdict != Verdict::FalseAlarm && verdict != Verdict::CorrectReject) without_target = false;
    }
    if (!without_target) continue;
    ++frames;
    sightings += trajectory.frames[k].sightings.size();
  }
  return ratio(1000 * sightings, frames);
}

// Recorded time goes from the first frame to one period after the last.
Share spurious_per_minute(const Recording& recording, size_t spurious) {
  if (recording.captured.empty()) return {};
  const Duration recorded = recording.captured.back() + recording.period - recording.captured.front();
  return ratio(static_cast<double>(spurious), in_seconds(recorded) / 60);
}

}  // namespace

ScoreSheet score(const Recording& recording, const Trajectory& trajectory, const Evaluation& evaluation) {
  ScoreSheet sheet;
  Heap pooled;
  for (size_t t = 0; t < evaluation.targets.size(); ++t) {
    Heap own;
    add_target(own, recording, trajectory, t, evaluation.targets[t]);
    add_target(pooled, recording, trajectory, t, evaluation.targets[t]);
    sheet.targets.push_back(scores_of(own));
  }
  for (const int count : evaluation.spurious) pooled.counts.spurious += static_cast<size_t>(count);
  for (const int count : evaluation.ignored) pooled.counts.ignored += static_cast<size_t>(count);
  sheet.pooled = scores_of(pooled);
  sheet.pooled.false_alarms_per_1000 = false_alarms_per_1000(trajectory, evaluation);
  sheet.pooled.spurious_per_minute = spurious_per_minute(recording, pooled.counts.spurious);
  return sheet;
}

}  // namespace relock::naive
