#include "eval/inspection/inspection.h"

#include <algorithm>
#include <cmath>

#include "eval/definitions.h"
#include "eval/replay/replay.h"
#include "eval/scores/localization.h"

namespace relock {
namespace {

/// Values with the frames that they are of.
class Values {
 public:
  void add(double value, std::size_t frame) {
    if (values_.empty() || value > most_) most_ = value, most_at_ = static_cast<FrameIndex>(frame);
    values_.push_back(value);
  }
  std::optional<Spread> spread() const {
    if (values_.empty()) return {};
    return Spread{*std::min_element(values_.begin(), values_.end()), percentile(values_, 0.5),
                  percentile(values_, 0.95), most_, most_at_};
  }

 private:
  std::vector<double> values_;
  double most_ = 0;
  FrameIndex most_at_ = 0;
};

Duration interval_before(const Recording& recording, std::size_t frame) {
  return recording.captured[frame] - recording.captured[frame - 1];
}

std::size_t bin_of(std::int64_t slots) {
  std::size_t bin = 0;
  while (slots > kSlotBins[bin].to) ++bin;
  return bin;
}

std::optional<Jitter> jitter_of(const Recording& recording, std::span<const std::int64_t> slots) {
  Jitter jitter;
  double sum = 0, squares = 0;  // of deviations from T, ms
  for (std::size_t i = 0; i < slots.size(); ++i) {
    if (slots[i] != 1) continue;
    const double off = 1e3 * seconds(interval_before(recording, i + 1) - recording.period);
    sum += off, squares += off * off;
    if (jitter.intervals++ == 0 || std::abs(off) > std::abs(jitter.largest_ms))
      jitter.largest_ms = off, jitter.largest_at = static_cast<FrameIndex>(i + 1);
  }
  if (jitter.intervals == 0) return {};
  const double n = static_cast<double>(jitter.intervals), mean = sum / n;
  jitter.deviation_ms = std::sqrt(std::max(0.0, squares / n - mean * mean));
  return jitter;
}

IntervalInspection inspect_intervals(const Recording& recording) {
  IntervalInspection found;
  std::int64_t all = 0, missing = 0;
  Duration longest{};
  for (std::size_t frame = 1; frame < recording.frames(); ++frame) {
    const Duration interval = interval_before(recording, frame);
    const std::int64_t spanned = slots(interval, recording.period);
    found.slots.push_back(spanned);
    ++found.histogram[bin_of(spanned)];
    if (interval > kPause) {
      found.pauses.push_back(static_cast<FrameIndex>(frame));
    } else {
      all += spanned, missing += spanned - 1;
    }
    if (spanned < 2) continue;
    ++found.gaps;
    if (interval > longest) longest = interval, found.longest_gap_before = static_cast<FrameIndex>(frame);
  }
  if (all > 0) found.missing_share = static_cast<double>(missing) / static_cast<double>(all);
  found.jitter = jitter_of(recording, found.slots);
  return found;
}

void count_labels(const Recording& recording, std::size_t target, TargetInspection& found) {
  Label before = Label::unlabelled;
  std::optional<std::size_t> labelled;
  for (std::size_t frame = 0; frame < recording.frames(); ++frame) {
    const Label label = recording.truth_of(frame, target).label;
    ++(label == Label::visible ? found.visible : label == Label::absent ? found.absent : found.unlabelled);
    if (label == Label::unlabelled) continue;
    if (before == Label::visible && label == Label::absent) ++found.departures;
    if (before == Label::absent && label == Label::visible) ++found.returns;
    if (labelled && frame - *labelled > 1) {
      const Duration hole = recording.captured[frame] - recording.captured[*labelled];
      found.longest_unlabelled = std::max(found.longest_unlabelled.value_or(hole), hole);
    }
    before = label, labelled = frame;
  }
  if (found.first_startable && labelled)
    found.seen_for =
        recording.captured[*labelled] - recording.captured[static_cast<std::size_t>(*found.first_startable)];
}

void measure_target(const Recording& recording, std::size_t target, TargetInspection& found) {
  Values sizes, steps, sigmas, blurs;
  for (std::size_t frame = 0; frame < recording.frames(); ++frame) {
    const TargetTruth& truth = recording.truth_of(frame, target);
    if (truth.label != Label::visible) continue;
    sizes.add(truth.size_px(), frame);
    sigmas.add(truth.sigma_px, frame);
    if (truth.blur) blurs.add(norm(*truth.blur), frame);
    if (frame == 0 || interval_before(recording, frame) > kPause) continue;
    const TargetTruth& before = recording.truth_of(frame - 1, target);
    if (before.label != Label::visible) continue;
    const Vec2 way = truth.centre(CentreKind::projected) - before.centre(CentreKind::projected);
    steps.add(norm(way) / before.size_px(), frame);
  }
  found.size_px = sizes.spread();
  found.step_d = steps.spread();
  found.label_sigma_px = sigmas.spread();
  found.true_blur_px = blurs.spread();
}

}  // namespace

Inspection inspect(const Recording& recording) {
  Inspection found;
  found.intervals = inspect_intervals(recording);
  const auto starts = first_startable(recording);
  for (std::size_t target = 0; target < recording.targets.size(); ++target) {
    TargetInspection& one = found.targets.emplace_back();
    one.first_startable = starts[target];
    count_labels(recording, target, one);
    measure_target(recording, target, one);
  }
  return found;
}

BlurSummary summarise(std::span<const BlurOfFrame> frames) {
  BlurSummary summary;
  Values px, shares;
  for (const BlurOfFrame& asked : frames) {
    if (!asked.blur) {
      ++summary.declined;
      continue;
    }
    ++(asked.blur->length_px > 0 ? summary.measured : summary.below);
    px.add(asked.blur->length_px, static_cast<std::size_t>(asked.frame));
    if (asked.size_px)
      shares.add(asked.blur->length_px / *asked.size_px, static_cast<std::size_t>(asked.frame));
  }
  if (summary.declined > summary.measured + summary.below) return summary;  // the rest is no fair sample
  summary.length_px = px.spread();
  summary.length_d = shares.spread();
  return summary;
}

}  // namespace relock
