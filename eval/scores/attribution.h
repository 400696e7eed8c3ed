#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "eval/judgement/evaluation.h"
#include "eval/statistics/firth.h"
#include "eval/statistics/interval.h"

namespace relock {

/// A step between consecutive delivered, visible, scored frames, the method locked at the first (metrics.md
/// section 7): what came with it, and whether a loss began in it.
struct Transition {
  double injected_slots = 0;           ///< frames that the gap pattern dropped within
  double recorded_slots = 0;           ///< slots lost in the recording
  double skipped_slots = 0;            ///< frames for which the method was busy
  std::optional<double> blur;          ///< on arrival, in tenths of D
  std::optional<double> displacement;  ///< of the target, in tenths of D
  bool lost = false;                   ///< the onset of a loss lies in it
};
std::vector<Transition> transitions(const Recording& recording, const Trajectory& trajectory,
                                    std::size_t target, const TargetTimeline& timeline);

/// Transitions of one target in one run, in order.
struct TransitionRun {
  std::size_t sequence = 0;  ///< runs on the same recording have the same number
  std::vector<Transition> transitions;
};

/// Whether gaps came with the recording or were drawn.
enum class Gaps : std::uint8_t { recorded, injected };

/// What one more unit of a covariate does to the odds of a loss, others equal.
struct Effect {
  enum class Covariate : std::uint8_t { injected_slots, recorded_slots, skipped_slots, blur, displacement };
  Covariate covariate = Covariate::recorded_slots;
  double odds_ratio = 1;
  std::optional<Interval> interval;  ///< nothing: too few resamples could be fitted
  bool because = false;              ///< drawn at random, so a cause; else it only goes with losses
};

/// Why nothing is told, or not all.
enum class TooFew : std::uint8_t {
  none,    ///< something is
  losses,  ///< fewer than kLeastLosses
  variation,  ///< no covariate varies enough: fewer than kLeastVaried transitions differ from its commonest value
  not_converged,  ///< the fit of a model found no end, so that its effects are not told; another model's may be
};
constexpr std::size_t kLeastLosses = 10;
constexpr std::size_t kLeastVaried = 10;

struct Attribution {
  std::size_t transitions = 0, losses = 0, sequences = 0;
  TooFew too_few = TooFew::none;
  /// Of the model with slots and blur, and of the one with displacement, which stands between them and the loss
  /// and so has a model of its own. Blur and displacement only where they are known of every transition.
  std::vector<Effect> effects;
};

/// Firth-penalised logistic regressions (statistics/firth.h). Intervals: with kManySequences or more sequences
/// by the scatter of the scores between them (the sandwich estimator), and Student's t; below, by a stationary
/// block bootstrap (Politis and Romano 1994) of kBlockResamples refits, blocks of kMeanBlock transitions in the
/// mean, and never narrower than the profile-likelihood interval.
Attribution attribute(std::span<const TransitionRun> runs, Gaps gaps, const FirthOptions& options = {});
constexpr int kBlockResamples = 400;
constexpr double kMeanBlock = 30;

/// "each extra slot of gap multiplies the odds of a loss by 2.3 [1.8, 3.1] (because: the gaps were injected)",
/// "each 10 % of D of blur goes with odds of a loss 1.4 [1.1, 1.9] times as high".
std::string sentence(const Effect& effect);
/// "too few losses to tell: 4, and 10 are needed", "12 losses in 340 transitions".
std::string sentence(const Attribution& attribution);

}  // namespace relock
