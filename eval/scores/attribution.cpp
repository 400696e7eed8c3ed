#include "eval/scores/attribution.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/random.h"
#include "eval/judgement/circumstances.h"
#include "eval/scores/localization.h"
#include "eval/statistics/firth.h"
#include "eval/statistics/long_run.h"

namespace relock {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Covariate = Effect::Covariate;

constexpr std::uint64_t kSeed = 1994;

std::optional<double> value(const Transition& t, Covariate covariate) {
  switch (covariate) {
    case Covariate::injected_slots:
      return t.injected_slots;
    case Covariate::recorded_slots:
      return t.recorded_slots;
    case Covariate::skipped_slots:
      return t.skipped_slots;
    case Covariate::blur:
      return t.blur;
    case Covariate::displacement:
      return t.displacement;
  }
  return {};
}

/// All transitions as the rows of a regression.
struct Rows {
  MatrixXd covariates;  // the first column is the intercept
  VectorXd lost;
  std::vector<std::size_t> sequence;                      // of each row
  std::vector<std::pair<std::size_t, std::size_t>> runs;  // first row and number of rows of each
};

Rows rows_of(std::span<const TransitionRun> runs, const std::vector<Covariate>& covariates) {
  Rows rows;
  std::size_t count = 0;
  for (const TransitionRun& run : runs) count += run.transitions.size();
  rows.covariates = MatrixXd::Ones(static_cast<Index>(count), static_cast<Index>(covariates.size()) + 1);
  rows.lost = VectorXd::Zero(static_cast<Index>(count));
  Index row = 0;
  for (const TransitionRun& run : runs) {
    if (!run.transitions.empty()) rows.runs.emplace_back(row, run.transitions.size());
    for (const Transition& t : run.transitions) {
      for (std::size_t c = 0; c < covariates.size(); ++c)
        rows.covariates(row, static_cast<Index>(c) + 1) = value(t, covariates[c]).value();
      rows.lost[row++] = t.lost ? 1 : 0;
      rows.sequence.push_back(run.sequence);
    }
  }
  return rows;
}

/// Known of every transition, and not nearly the same in all of them.
bool tells(std::span<const TransitionRun> runs, Covariate covariate) {
  std::map<double, std::size_t> counts;
  std::size_t all = 0, commonest = 0;
  for (const TransitionRun& run : runs) {
    for (const Transition& t : run.transitions) {
      const auto known = value(t, covariate);
      if (!known) return false;
      commonest = std::max(commonest, ++counts[*known]);
      ++all;
    }
  }
  return all - commonest >= kLeastVaried;
}

/// From the scatter of the sequences' scores: Liang and Zeger 1986.
std::vector<std::optional<Interval>> between_sequences(const Rows& rows, const FirthFit& fit) {
  const MatrixXd scores = penalised_scores(rows.covariates, rows.lost, fit);
  std::map<std::size_t, VectorXd> sums;
  for (Index row = 0; row < scores.rows(); ++row) {
    VectorXd& sum =
        sums.try_emplace(rows.sequence[static_cast<std::size_t>(row)], VectorXd::Zero(scores.cols()))
            .first->second;
    sum += scores.row(row).transpose();
  }
  const auto count = static_cast<double>(sums.size());
  MatrixXd scatter = MatrixXd::Zero(scores.cols(), scores.cols());
  for (const auto& [sequence, sum] : sums) scatter += sum * sum.transpose() * count / (count - 1);
  const MatrixXd variance = fit.covariance * scatter * fit.covariance;
  std::vector<std::optional<Interval>> intervals;
  for (Index c = 0; c < scores.cols(); ++c) {
    const double half = student_quantile(count - 1) * std::sqrt(variance(c, c));
    intervals.push_back(Interval{fit.coefficients[c] - half, fit.coefficients[c] + half});
  }
  return intervals;
}

/// How often a resample of blocks has each row: blocks begin anywhere and go on after a run's end at its
/// beginning; their lengths are geometric.
VectorXd block_weights(const Rows& rows, Random& random) {
  VectorXd weights = VectorXd::Zero(rows.lost.size());
  for (const auto& [first, count] : rows.runs) {
    std::size_t at = 0;
    for (std::size_t drawn = 0; drawn < count; ++drawn) {
      at = drawn == 0 || random.chance(1 / kMeanBlock) ? random.below(count) : (at + 1) % count;
      weights[static_cast<Index>(first + at)] += 1;
    }
  }
  return weights;
}

/// The rows that a resample has, as often as it has them; the others would only cost time.
struct Resample {
  MatrixXd covariates;
  VectorXd lost, weights;
};
Resample resample(const Rows& rows, Random& random) {
  const VectorXd weights = block_weights(rows, random);
  std::vector<Index> drawn;
  for (Index row = 0; row < weights.size(); ++row)
    if (weights[row] > 0) drawn.push_back(row);
  return {rows.covariates(drawn, Eigen::all), rows.lost(drawn), weights(drawn)};
}

/// Percentiles of refits to resamples of blocks.
std::vector<std::optional<Interval>> within_sequences(const Rows& rows, const FirthFit& fit) {
  std::vector<std::vector<double>> refits(static_cast<std::size_t>(fit.coefficients.size()));
  Random random(kSeed);
  const FirthOptions roughly{50, 1e-4};  // a hundredth of a standard error
  for (int i = 0; i < kBlockResamples; ++i) {
    const Resample drawn = resample(rows, random);
    const auto refit = firth(drawn.covariates, drawn.lost, drawn.weights, fit.coefficients, roughly);
    if (!refit || !refit->converged) continue;
    for (std::size_t c = 0; c < refits.size(); ++c)
      refits[c].push_back(refit->coefficients[static_cast<Index>(c)]);
  }
  std::vector<std::optional<Interval>> intervals;
  intervals.emplace_back();  // nobody asks for the intercept's
  for (std::size_t c = 1; c < refits.size(); ++c) {
    std::optional<Interval>& interval = intervals.emplace_back();
    if (refits[c].size() < kBlockResamples / 2) continue;
    interval =
        Interval{percentile(refits[c], (1 - kConfidence) / 2), percentile(refits[c], (1 + kConfidence) / 2)};
    // Of few losses the percentiles are too narrow even where transitions are independent.
    const auto profile = profile_interval(rows.covariates, rows.lost, fit, static_cast<Index>(c));
    if (profile) *interval = {std::min(interval->low, profile->low), std::max(interval->high, profile->high)};
  }
  return intervals;
}

void add_effects(std::span<const TransitionRun> runs, const std::vector<Covariate>& covariates,
                 const FirthOptions& options, Attribution& found) {
  if (covariates.empty()) return;
  const Rows rows = rows_of(runs, covariates);
  const auto fit = firth(rows.covariates, rows.lost, {}, {}, options);
  if (!fit) return;
  if (!fit->converged) {
    found.too_few = TooFew::not_converged;  // where the steps ended is no estimate
    return;
  }
  const auto intervals =
      found.sequences >= kManySequences ? between_sequences(rows, *fit) : within_sequences(rows, *fit);
  for (std::size_t c = 0; c < covariates.size(); ++c) {
    Effect& effect = found.effects.emplace_back();
    effect.covariate = covariates[c];
    effect.odds_ratio = std::exp(fit->coefficients[static_cast<Index>(c) + 1]);
    if (const auto& log_odds = intervals[c + 1])
      effect.interval = Interval{std::exp(log_odds->low), std::exp(log_odds->high)};
    effect.because = covariates[c] == Covariate::injected_slots;
  }
}

/// The loss whose onset begins at `frame`, if there is one.
const Loss* loss_after(const TargetTimeline& timeline, FrameIndex frame) {
  const auto found = std::find_if(timeline.losses.begin(), timeline.losses.end(),
                                  [&](const Loss& loss) { return loss.last_good == frame; });
  return found == timeline.losses.end() ? nullptr : &*found;
}

}  // namespace

std::vector<Transition> transitions(const Recording& recording, const Trajectory& trajectory,
                                    std::size_t target, const TargetTimeline& timeline) {
  std::vector<Transition> found;
  std::optional<std::size_t> before;  // the last delivered frame, if it was scored
  for (std::size_t frame = 0; frame < timeline.judgements.size(); ++frame) {
    if (trajectory.frames[frame].delivery != Delivery::delivered) continue;
    const bool is_scored = scored(timeline.judgements[frame].verdict);
    if (is_scored && before) {
      // A state is told with hindsight: from the last good frame on it is Lost already.
      const Loss* loss = loss_after(timeline, static_cast<FrameIndex>(*before));
      if (loss || timeline.states[*before] == State::Locked) {
        const Circumstances with =
            circumstances(recording, trajectory, target, static_cast<FrameIndex>(frame));
        Transition& t = found.emplace_back();
        t.injected_slots = static_cast<double>(with.slots_injected);
        t.recorded_slots = static_cast<double>(with.slots_recorded);
        t.skipped_slots = static_cast<double>(with.slots_skipped);
        if (with.blur_px && with.size_px) t.blur = 10 * *with.blur_px / *with.size_px;
        if (with.displacement_d) t.displacement = 10 * *with.displacement_d;
        t.lost = loss && loss->first_lost == static_cast<FrameIndex>(frame);
      }
    }
    before = is_scored ? std::optional(frame) : std::nullopt;
  }
  return found;
}

Attribution attribute(std::span<const TransitionRun> runs, Gaps gaps, const FirthOptions& options) {
  Attribution found;
  std::set<std::size_t> sequences;
  for (const TransitionRun& run : runs) {
    if (run.transitions.empty()) continue;
    sequences.insert(run.sequence);
    found.transitions += run.transitions.size();
    for (const Transition& t : run.transitions) found.losses += t.lost ? 1 : 0;
  }
  found.sequences = sequences.size();
  if (found.losses < kLeastLosses) {
    found.too_few = TooFew::losses;
    return found;
  }
  const auto telling = [&](std::vector<Covariate> covariates) {
    std::erase_if(covariates, [&](Covariate c) { return !tells(runs, c); });
    return covariates;
  };
  std::vector<Covariate> causes{Covariate::recorded_slots, Covariate::skipped_slots, Covariate::blur};
  if (gaps == Gaps::injected) causes.insert(causes.begin(), Covariate::injected_slots);
  add_effects(runs, telling(causes), options, found);
  add_effects(runs, telling({Covariate::displacement}), options, found);
  if (found.effects.empty() && found.too_few == TooFew::none) found.too_few = TooFew::variation;
  return found;
}

namespace {

/// Two digits, or as many as stand before the point.
std::string odds(double ratio) {
  return fmt::format("{:.{}f}", ratio, ratio >= 9.95 ? 0 : ratio >= 0.995 ? 1 : 2);
}

}  // namespace

std::string sentence(const Effect& effect) {
  static const std::map<Covariate, std::string> kUnits{
      {Covariate::injected_slots, "extra slot of gap"},
      {Covariate::recorded_slots, "extra slot of gap in the recording"},
      {Covariate::skipped_slots, "extra slot that the method was busy"},
      {Covariate::blur, "10 % of D of blur"},
      {Covariate::displacement, "10 % of D that the target moved"}};
  const std::string limits =
      effect.interval ? fmt::format(" [{}, {}]", odds(effect.interval->low), odds(effect.interval->high))
                      : "";
  if (effect.because)
    return fmt::format("each {} multiplies the odds of a loss by {}{} (because: the gaps were injected)",
                       kUnits.at(effect.covariate), odds(effect.odds_ratio), limits);
  return fmt::format("each {} goes with odds of a loss {}{} times as high", kUnits.at(effect.covariate),
                     odds(effect.odds_ratio), limits);
}

std::string sentence(const Attribution& attribution) {
  switch (attribution.too_few) {
    case TooFew::losses:
      return fmt::format("too few losses to tell: {} in {} transitions, and {} are needed",
                         attribution.losses, attribution.transitions, kLeastLosses);
    case TooFew::variation:
      return fmt::format("too little varies to tell what its {} losses go with", attribution.losses);
    case TooFew::not_converged:
    case TooFew::none:
      break;
  }
  return fmt::format("{} losses in {} transitions{}", attribution.losses, attribution.transitions,
                     attribution.too_few == TooFew::none ? ""
                     : attribution.effects.empty()
                         ? "; the fit did not converge, so no effect is told"
                         : "; one fit did not converge, and its effects are left out");
}

}  // namespace relock
