#include "cli/compare/changes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "cli/comparison.h"
#include "cli/runs/copies.h"
#include "cli/scores/tables.h"
#include "eval/loss_text.h"
#include "eval/scores/common_frames.h"
#include "eval/scores/localization.h"

namespace relock {
namespace {

/// One folder's sums on one recording, all its runs added up frame by frame.
struct Sums {
  std::vector<Contribution> frames;
  std::vector<double> losses;
};

/// Both folders' on one recording.
struct BothSums {
  Sums before, after;
  struct Errors {
    std::size_t frame;
    double before_px, after_px, label_sigma_px;
  };
  std::vector<Errors> errors;  // of Hits in both
};

/// A pair of runs, judged, as long as the shorter of them.
struct Judged {
  const RunPair& pair;
  Recording recording;
  Trajectory before, after;
  Evaluation judged_before, judged_after;
  std::vector<bool> asked;  // of each target, whether both were
};

Judged judge(const RunPair& pair, const Gate& gate) {
  const Recording& whole = pair.comparison->recording;
  const std::size_t frames =
      std::min({whole.frames(), pair.before->trajectory.frames.size(), pair.after->trajectory.frames.size()});
  Judged judged{pair,
                up_to(whole, frames),
                up_to(pair.before->trajectory, frames),
                up_to(pair.after->trajectory, frames),
                {},
                {},
                {}};
  judged.judged_before = evaluate(judged.recording, judged.before, gate);
  judged.judged_after = evaluate(judged.recording, judged.after, gate);
  for (std::size_t t = 0; t < whole.targets.size(); ++t)
    judged.asked.push_back(judged.before.judged_from[t] && judged.after.judged_from[t]);
  return judged;
}

// Sums

std::size_t place(const Judged& judged, std::size_t frame) {
  return recorded_frame(*judged.pair.comparison, *judged.pair.before, frame);
}

void add(const Judged& judged, const Evaluation& evaluation, Sums& sums) {
  const StoredComparison& stored = *judged.pair.comparison;
  const std::size_t size = std::max({sums.frames.size(), stored.recorded_frames, stored.recording.frames()});
  sums.frames.resize(size);
  sums.losses.resize(size);
  std::vector<Contribution> spurious(judged.recording.frames());
  add_spurious(spurious, evaluation);
  for (std::size_t frame = 0; frame < spurious.size(); ++frame)
    sums.frames[place(judged, frame)] += spurious[frame];
  for (std::size_t t = 0; t < judged.asked.size(); ++t) {
    if (!judged.asked[t]) continue;
    const auto frames = contributions(judged.recording, evaluation, t);
    for (std::size_t frame = 0; frame < frames.size(); ++frame)
      sums.frames[place(judged, frame)] += frames[frame];
    for (const Loss& loss : evaluation.targets[t].losses)
      ++sums.losses[place(judged, static_cast<std::size_t>(loss.last_good))];
  }
}

void add_errors(const Judged& judged, BothSums& sums) {
  for (std::size_t t = 0; t < judged.asked.size(); ++t) {
    if (!judged.asked[t]) continue;
    for (std::size_t frame = 0; frame < judged.recording.frames(); ++frame) {
      const Judgement &a = judged.judged_before.targets[t].judgements[frame],
                      &b = judged.judged_after.targets[t].judgements[frame];
      if (a.verdict == Verdict::Hit && b.verdict == Verdict::Hit)
        sums.errors.push_back(
            {place(judged, frame), a.error_px, b.error_px, judged.recording.truth_of(frame, t).sigma_px});
    }
  }
}

// Scores

RatioSeries series_of(ComparedScore score, const Sums& sums) {
  constexpr std::array<std::size_t, 4> kShares{0, 1, 2, 4};  // of share_scores(), as in ComparedScore
  RatioSeries series;
  if (score == ComparedScore::losses_per_minute) {
    series.part = sums.losses;
    for (const Contribution& frame : sums.frames) series.whole.push_back(seconds(frame.locked) / 60);
    return series;
  }
  const ShareScore& share = share_scores()[kShares[static_cast<std::size_t>(score)]];
  for (const Contribution& frame : sums.frames) {
    series.part.push_back(share.part(frame));
    series.whole.push_back(share.whole(frame));
  }
  return series;
}

ScoreChange ratio_change(ComparedScore score, const std::vector<BothSums>& recordings) {
  std::vector<RatioSeries> before, after;
  for (const BothSums& sums : recordings) {
    before.push_back(series_of(score, sums.before));
    after.push_back(series_of(score, sums.after));
  }
  ScoreChange change{value_of(before), value_of(after), {}, {}};
  if (!change.before || !change.after) return change;
  change.difference = *change.after - *change.before;
  change.interval = difference_interval(after, before);
  return change;
}

ScoreChange error_change(const std::vector<BothSums>& recordings) {
  std::vector<double> before, after, all;
  std::vector<std::vector<FramedValue>> differences;
  for (const BothSums& sums : recordings) {
    differences.emplace_back();
    for (const auto& [frame, before_px, after_px, sigma_px] : sums.errors) {
      before.push_back(before_px);
      after.push_back(after_px);
      all.push_back(after_px - before_px);
      differences.back().push_back({frame, after_px - before_px});
    }
  }
  if (all.empty()) return {};
  return {percentile(before, 0.5), percentile(after, 0.5), percentile(all, 0.5),
          quantile_interval(differences, 0.5)};
}

ScoreChange loss_count(const std::vector<BothSums>& recordings) {
  double before = 0, after = 0;
  for (const BothSums& sums : recordings) {
    for (const double losses : sums.before.losses) before += losses;
    for (const double losses : sums.after.losses) after += losses;
  }
  return {before, after, after - before, {}};
}

double label_sigma(const std::vector<BothSums>& recordings) {
  double squares = 0, count = 0;
  for (const BothSums& sums : recordings)
    for (const auto& error : sums.errors) squares += error.label_sigma_px * error.label_sigma_px, ++count;
  return count > 0 ? std::sqrt(squares / count) : 0;
}

// Losses

std::string where(const Judged& judged, std::size_t target) {
  const RunRecord& record = judged.pair.before->record;
  std::string text = record.recording;
  if (judged.recording.targets.size() > 1)
    text += fmt::format(", target {}", judged.recording.targets[target].id);
  if (record.gaps != "none") text += fmt::format(", seed {}", record.seed);
  if (record.anchor) text += fmt::format(", {}", to_string(*record.anchor));
  return text;
}

ChangedLoss told(const Judged& judged, std::size_t target, const LossChange& change) {
  const Loss& loss = change.after ? *change.after : *change.before;
  const Trajectory& of = change.after ? judged.after : judged.before;
  const Circumstances with = circumstances(judged.recording, of, target, loss);
  const auto at = [&](const std::optional<Loss>& one) -> std::optional<double> {
    if (!one) return {};
    return seconds(judged.recording.captured[static_cast<std::size_t>(one->last_good)] -
                   judged.recording.captured.front());
  };
  const RunRecord& record = judged.pair.before->record;
  return {record.recording,
          judged.recording.targets[target].id,
          record.seed,
          record.anchor,
          change,
          where(judged, target),
          fmt::format("{}; {}", onset_text(judged.recording, loss, with, gap_note(with)),
                      end_text(judged.recording, loss)),
          at(change.before),
          at(change.after)};
}

void add_losses(const Judged& judged, MethodChange& method) {
  for (std::size_t t = 0; t < judged.asked.size(); ++t)
    if (judged.asked[t])
      for (const LossChange& change : loss_changes(judged.recording, judged.judged_before.targets[t].losses,
                                                   judged.judged_after.targets[t].losses))
        method.losses.push_back(told(judged, t, change));
}

// Groups

using Pairs = std::vector<const RunPair*>;

template <class Value>
void add_new(std::vector<Value>& all, const Value& value) {
  if (std::find(all.begin(), all.end(), value) == all.end()) all.push_back(value);
}

using Names = std::pair<std::string, std::string>;  // in A and in B

Names names_of(const RunPair& pair) { return {pair.before->record.method, pair.after->record.method}; }

MethodChange method_change(const Names& names, const Pairs& pairs, const Gate& gate) {
  MethodChange method{.method = names.first, .method_in_b = names.second, .scores = {}, .losses = {}};
  std::map<std::string, BothSums> by_recording;
  for (const RunPair* pair : pairs) {
    const RunRecord& record = pair->before->record;
    if (names_of(*pair) != names) continue;
    method.deterministic = method.deterministic && record.deterministic && pair->after->record.deterministic;
    ++method.runs;
    method.same_runs += hash_of_answers(*pair->before) == hash_of_answers(*pair->after) ? 1 : 0;
    const Judged judged = judge(*pair, gate);
    BothSums& sums = by_recording[record.recording];
    add(judged, judged.judged_before, sums.before);
    add(judged, judged.judged_after, sums.after);
    add_errors(judged, sums);
    add_losses(judged, method);
  }
  std::vector<BothSums> recordings;
  for (auto& [recording, sums] : by_recording) recordings.push_back(std::move(sums));
  for (std::size_t i = 0; i <= static_cast<std::size_t>(ComparedScore::losses_per_minute); ++i)
    method.scores[i] = ratio_change(static_cast<ComparedScore>(i), recordings);
  method.scores[static_cast<std::size_t>(ComparedScore::error_px)] = error_change(recordings);
  method.scores[static_cast<std::size_t>(ComparedScore::losses)] = loss_count(recordings);
  method.label_sigma_px = label_sigma(recordings);
  return method;
}

/// `pairs` are of one pattern, showing and gate.
ConditionsChange conditions_change(const Pairs& pairs, const std::optional<std::string>& gate) {
  const RunRecord& record = pairs.front()->before->record;
  Showing showing = record.showing();
  showing.anchor.reset();
  ConditionsChange group{{record.gaps, showing, gate_of(*pairs.front()->comparison, gate), {}, {}}, {}};
  std::vector<Names> methods;
  for (const RunPair* pair : pairs) {
    add_new(group.recordings, pair->before->record.recording);
    add_new(group.seeds, pair->before->record.seed);
    add_new(methods, names_of(*pair));
  }
  for (const Names& names : methods) group.methods.push_back(method_change(names, pairs, group.gate));
  return group;
}

}  // namespace

std::string_view name_of(ComparedScore score) {
  constexpr std::array<std::string_view, kComparedScores> names{
      "recognition", "precision", "availability", "locked-share", "losses-per-minute", "error-px", "losses"};
  return names[static_cast<std::size_t>(score)];
}

bool more_is_better(ComparedScore score) { return score < ComparedScore::losses_per_minute; }

bool has_interval(ComparedScore score) { return score != ComparedScore::losses; }

int verdict_on(ComparedScore score, const std::optional<Interval>& difference) {
  if (!difference || (difference->low <= 0 && difference->high >= 0)) return 0;
  return (difference->low > 0) == more_is_better(score) ? 1 : -1;
}

std::size_t MethodChange::count(LossFate fate) const {
  return static_cast<std::size_t>(std::count_if(
      losses.begin(), losses.end(), [&](const ChangedLoss& loss) { return loss.change.fate == fate; }));
}

FolderChange changes(const std::vector<StoredComparison>& a, const std::vector<StoredComparison>& b,
                     const std::optional<std::string>& gate, const std::vector<MethodPair>& methods) {
  const RunPairs found = run_pairs(a, b, methods);
  std::map<std::tuple<std::string, Showing, std::string>, Pairs> groups;
  for (const RunPair& pair : found.pairs) {
    const RunRecord& record = pair.before->record;
    Showing showing = record.showing();
    showing.anchor.reset();
    groups[{record.gaps, showing, record.gate}].push_back(&pair);
  }
  FolderChange change{{}, found.only_in_a, found.only_in_b, found.left_out};
  for (const auto& [key, pairs] : groups) change.groups.push_back(conditions_change(pairs, gate));
  return change;
}

}  // namespace relock
