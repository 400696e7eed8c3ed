#include "eval/scores/paired.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "eval/scores/common_frames.h"
#include "eval/scores/contribution.h"
#include "eval/scores/localization.h"
#include "eval/statistics/ratio.h"

namespace relock {
namespace {

/// Both arms of one sequence, its seeds added up: for each recorded frame what it adds to every score.
struct SequenceSums {
  ArmSums without, with;
  struct Errors {
    std::size_t frame;
    double without_px, with_px, label_sigma_px;
  };
  std::vector<Errors> errors;  // of Hits in both arms
};

void add_errors(const CommonFrames& both, const Evaluation& without, const Evaluation& with,
                SequenceSums& sums) {
  for (std::size_t t = 0; t < both.recording.targets.size(); ++t) {
    for (std::size_t frame = 0; frame < both.recording.frames(); ++frame) {
      const Judgement &a = without.targets[t].judgements[frame], &b = with.targets[t].judgements[frame];
      if (a.verdict == Verdict::Hit && b.verdict == Verdict::Hit)
        sums.errors.push_back({frame, a.error_px, b.error_px, both.recording.truth_of(frame, t).sigma_px});
    }
  }
}

std::size_t count_losses(const Evaluation& evaluation) {
  std::size_t count = 0;
  for (const TargetTimeline& timeline : evaluation.targets) count += timeline.losses.size();
  return count;
}

void add_pair(const Pair& pair, const Gate& gate, SequenceSums& sums, GapCost& cost) {
  const CommonFrames both = common_frames(pair.recording, pair.without, pair.with);
  const Evaluation without = evaluate(both.recording, both.without, gate);
  const Evaluation with = evaluate(both.recording, both.with, gate);
  const std::vector<bool> all_targets(both.recording.targets.size(), true);
  sums.without.add(both.recording, without, all_targets);
  sums.with.add(both.recording, with, all_targets);
  add_errors(both, without, with, sums);
  ++cost.pairs;
  cost.common_frames += static_cast<std::size_t>(std::count(both.common.begin(), both.common.end(), true));
  cost.ended_at_reset += both.ends_at_reset ? 1 : 0;
  cost.losses_without += count_losses(without);
  cost.losses_with += count_losses(with);
}

// All recorded frames

void add_recorded_availability(const Recording& recording, const Trajectory& arm, const Gate& gate,
                               RatioSeries& sum) {
  const Evaluation evaluation = evaluate(recording, arm, gate);
  Contribution all;
  for (std::size_t t = 0; t < recording.targets.size(); ++t)
    for (const Contribution& frame : contributions(recording, evaluation, t)) all += frame;
  sum.part.push_back(seconds(all.fresh));
  sum.whole.push_back(seconds(all.visible));
}

// Scores

PairedScore paired_ratio(CostScore score, std::span<const SequenceSums> sequences) {
  std::vector<RatioSeries> without, with;
  for (const SequenceSums& sums : sequences) {
    without.push_back(sums.without[score]);
    with.push_back(sums.with[score]);
  }
  PairedScore paired{value_of(without), value_of(with), {}, {}};
  if (!paired.without || !paired.with) return paired;
  paired.difference = *paired.with - *paired.without;
  paired.interval = difference_interval(with, without);
  return paired;
}

double label_sigma(std::span<const SequenceSums> sequences) {
  double squares = 0, count = 0;
  for (const SequenceSums& sums : sequences) {
    for (const auto& errors : sums.errors) {
      squares += errors.label_sigma_px * errors.label_sigma_px;
      ++count;
    }
  }
  return count > 0 ? std::sqrt(squares / count) : 0;
}

using ByFrame = std::vector<FramedValue>;

ByFrame values(const SequenceSums& sums, double (*value)(const SequenceSums::Errors&)) {
  ByFrame all;
  for (const auto& one : sums.errors) all.push_back({one.frame, value(one)});
  return all;
}

/// The median of a value over the errors of all sequences.
std::optional<double> median(const std::vector<ByFrame>& by_sequence) {
  std::vector<double> all;
  for (const ByFrame& sequence : by_sequence)
    for (const FramedValue& one : sequence) all.push_back(one.value);
  if (all.empty()) return {};
  return percentile(all, 0.5);
}

PairedScore paired_error(std::span<const SequenceSums> sequences) {
  std::vector<ByFrame> without, with, differences;
  for (const SequenceSums& sums : sequences) {
    without.push_back(values(sums, [](const auto& e) { return e.without_px; }));
    with.push_back(values(sums, [](const auto& e) { return e.with_px; }));
    differences.push_back(values(sums, [](const auto& e) { return e.with_px - e.without_px; }));
  }
  PairedScore paired{median(without), median(with), median(differences), {}};
  if (paired.difference) paired.interval = quantile_interval(differences, 0.5);
  return paired;
}

}  // namespace

int verdict_on(CostScore which, const std::optional<Interval>& difference) {
  if (!difference || (difference->low <= 0 && difference->high >= 0)) return 0;
  const bool more = difference->low > 0;
  const bool more_is_better = which < CostScore::losses_per_minute;
  return more == more_is_better ? 1 : -1;
}

GapCost cost_of_gaps(std::span<const Pair> pairs, const Gate& gate) {
  GapCost cost;
  std::map<std::string, SequenceSums> by_name;
  RatioSeries recorded_without, recorded_with;
  for (const Pair& pair : pairs) {
    add_pair(pair, gate, by_name[pair.recording.name], cost);
    const std::size_t frames = frames_before_reset(pair.without, pair.with);
    const Recording recorded = up_to(pair.recording, frames);
    cost.frames += frames;
    add_recorded_availability(recorded, up_to(pair.without, frames), gate, recorded_without);
    add_recorded_availability(recorded, up_to(pair.with, frames), gate, recorded_with);
  }
  std::vector<SequenceSums> sequences;
  for (auto& [name, sums] : by_name) sequences.push_back(std::move(sums));
  for (std::size_t i = 0; i < kRatioScores; ++i)
    cost.scores[i] = paired_ratio(static_cast<CostScore>(i), sequences);
  cost.scores[kRatioScores] = paired_error(sequences);
  cost.label_sigma_px = label_sigma(sequences);
  cost.recorded_availability_without = value_of({&recorded_without, 1});
  cost.recorded_availability_with = value_of({&recorded_with, 1});
  return cost;
}

}  // namespace relock
