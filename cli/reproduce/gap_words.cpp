#include "cli/reproduce/gap_words.h"

#include <fmt/format.h>

#include <fmt/ranges.h>
#include <algorithm>

namespace relock::reproduction {
namespace {

const std::string kTracker = "blut";  // whose failing the paper reports
constexpr double kFar_d = 0.5;

/// What rounds to nothing has no sign.
std::string one_decimal(double value) {
  const std::string text = fmt::format("{:.1f}", value);
  return text == "-0.0" ? "0.0" : text;
}

double percent(const StepRisk& part, const StepRisk& whole, std::size_t StepRisk::*of) {
  return 100 * static_cast<double>(part.*of) / static_cast<double>(whole.*of);
}

std::string cause(const GapEffects& effects) {
  const bool jump = verdict_on(effects.jump) == EffectVerdict::more;
  const bool pause = verdict_on(effects.pause) == EffectVerdict::more;
  if (jump && pause)
    return "Both the jump over a gap and the time that passes in it make it lose the target.";
  if (jump) return "It is the jump over a gap that makes it lose the target, not the time that passes in it.";
  if (pause) return "It is the time that passes in a gap that makes it lose the target, not the jump.";
  return "Neither the jump over a gap nor its time is seen to make it lose the target.";
}

std::string cause_of(const std::vector<GapCount>& counts, const std::string& method) {
  const GapEffects effects = effects_of(loss_rates(counts, method));
  const std::string found =
      fmt::format("{}: to its losses per minute held a jump adds {}, a pause {}, blur {}.", method,
                  mean_cell(effects.jump), mean_cell(effects.pause), mean_cell(effects.blur));
  return effects.jump.interval ? found + " " + cause(effects) : found;
}

/// Started once, no protocol looks at the clock: what differs is the tracker's.
std::string clock_of(const std::vector<GapCount>& once, const std::string& method) {
  std::size_t flights = 0, same = 0;
  for (const GapCount* gaps : blurred(once, method, GapArm::gaps))
    for (const GapCount* jumps : blurred(once, method, GapArm::jumps))
      if (gaps->cell.seed == jumps->cell.seed) {
        ++flights;
        same += gaps->answers == jumps->answers ? 1 : 0;
      }
  if (flights == 0) return {};
  const std::string found = fmt::format(
      "Started once, {} answers to the frames of {} of {} flights the same whether time passes in the gaps "
      "or not",
      method, same, flights);
  return found + (same == flights ? ": it looks at no clock." : ".");
}

std::string near_of(const GapCounts& counts, const std::string& method) {
  NearGap sum;
  for (const GapCount* count : blurred(counts.reset, method, GapArm::gaps)) {
    const NearGap one = near_gaps(count->steps, counts.period);
    sum.near.steps += one.near.steps, sum.near.lost += one.near.lost;
    sum.all.steps += one.all.steps, sum.all.lost += one.all.lost;
  }
  if (sum.all.lost == 0) return {};
  return fmt::format(
      "With gaps, {:.0f} % of {}'s {} losses of blurred targets begin over a gap longer than 0.1 s or in the "
      "two steps after; {:.0f} % of all steps are such.",
      percent(sum.near, sum.all, &StepRisk::lost), method, sum.all.lost,
      percent(sum.near, sum.all, &StepRisk::steps));
}

/// How far a step goes that loses the target.
std::string reach_of(const std::vector<GapCount>& counts, const std::string& method) {
  StepRisk near, far;
  for (const GapArm arm : {GapArm::jumps, GapArm::gaps})
    for (const GapCount* count : blurred(counts, method, arm)) {
      const auto bins = risk_by_displacement(count->steps, {0, kFar_d});
      near.steps += bins[0].steps, near.lost += bins[0].lost;
      far.steps += bins[1].steps, far.lost += bins[1].lost;
    }
  if (near.steps == 0 || far.steps == 0) return {};
  return fmt::format(
      "Where frames are missing, {} loses a blurred target at {} of {} steps of less than {:g} D, and at {} "
      "of {} "
      "longer ones.",
      method, near.lost, near.steps, kFar_d, far.lost, far.steps);
}

std::string survival_of(const std::vector<GapCount>& counts, const std::string& method) {
  const auto lifetimes = lifetimes_of(counts, method, GapArm::gaps);
  if (lifetimes.empty()) return {};
  const TrackingSurvivals survival = tracking_survival(lifetimes);
  return fmt::format(
      "Given a blurred target again after each loss, with gaps, {} {}. The paper's \"about {:g} frames, "
      "within "
      "{:g} seconds\": {}.",
      method, sentence(survival), kClaimFrames, kClaimSeconds, to_string(judge_claim(survival)));
}

std::string recovery_of(const std::vector<GapCount>& once, const std::string& method) {
  std::size_t losses = 0, recovered = 0;
  for (const GapCount* count : blurred(once, method, GapArm::gaps))
    losses += count->losses, recovered += count->recovered;
  if (losses == 0) return {};
  return fmt::format("Started once, {} lost the target {} times over gaps and found it again {} times.",
                     method, losses, recovered);
}

}  // namespace

std::vector<const GapCount*> blurred(const std::vector<GapCount>& counts, const std::string& method,
                                     GapArm arm) {
  std::vector<const GapCount*> some;
  for (const GapCount& count : counts)
    if (count.method == method && count.cell.arm == arm && count.cell.blurred) some.push_back(&count);
  return some;
}

std::vector<TrackingLifetime> lifetimes_of(const std::vector<GapCount>& counts, const std::string& method,
                                           GapArm arm) {
  std::vector<TrackingLifetime> all;
  for (const GapCount* count : blurred(counts, method, arm))
    all.insert(all.end(), count->lifetimes.begin(), count->lifetimes.end());
  return all;
}

EffectVerdict verdict_on(const FlightMean& effect) {
  if (!effect.interval) return EffectVerdict::unknown;
  if (effect.interval->low > 0) return EffectVerdict::more;
  return effect.interval->high < 0 ? EffectVerdict::fewer : EffectVerdict::none_seen;
}

std::vector<std::string> gap_sentences(const GapCounts& counts, const std::vector<std::string>& reset,
                                       const std::vector<std::string>& once) {
  std::vector<std::string> sentences;
  for (const std::string& method : reset) sentences.push_back(cause_of(counts.reset, method));
  for (const std::string& method : once) sentences.push_back(clock_of(counts.once, method));
  sentences.push_back(reach_of(counts.reset, kTracker));
  sentences.push_back(near_of(counts, kTracker));
  for (const std::string& method : reset) sentences.push_back(survival_of(counts.reset, method));
  for (const std::string& method : once) sentences.push_back(recovery_of(counts.once, method));
  std::erase(sentences, "");
  return sentences;
}

std::string mean_cell(const FlightMean& mean) {
  const std::string value = one_decimal(mean.value);
  if (!mean.interval) return value;
  return fmt::format("{} [{}, {}]", value, one_decimal(mean.interval->low), one_decimal(mean.interval->high));
}

Json json_of(const FlightMean& mean) {
  return {{"mean", number(mean.value)}, {"interval", interval(mean.interval)}};
}

Json json_of(const GapEffects& effects) {
  return {{"jump", json_of(effects.jump)},
          {"pause", json_of(effects.pause)},
          {"blur", json_of(effects.blur)},
          {"jump_with_pause", json_of(effects.jump_with_pause)},
          {"jump_with_blur", json_of(effects.jump_with_blur)}};
}

}  // namespace relock::reproduction
