#include "cli/reproduce/gap_counts.h"

#include <algorithm>
#include <cmath>

#include "cli/reproduce/flight_scores.h"
#include "eval/statistics/interval.h"

namespace relock::reproduction {
namespace {

double held_minutes(const std::vector<State>& states, const Cut& cut, Duration period) {
  Duration held{0};
  for (std::size_t i = 0; i + 1 < cut.frames.size(); ++i)
    if (states[i] == State::Locked) held += (cut.frames[i + 1] - cut.frames[i]) * period;
  return seconds(held) / 60;
}

std::vector<std::optional<Vec2>> answers_of(const Trajectory& trajectory) {
  std::vector<std::optional<Vec2>> answers;
  for (const FrameReport& frame : trajectory.frames) {
    answers.emplace_back();
    if (!frame.sightings.empty()) answers.back() = frame.sightings.front().centre;
  }
  return answers;
}

/// One value of each flight: `by` of its losses per minute by arm and blur.
template <class Of>
FlightMean over_flights(const LossRates& rates, const Of& of) {
  std::vector<double> values;
  for (std::size_t flight = 0; flight < rates[0][0].size(); ++flight)
    values.push_back(of([&](GapArm arm, bool blurred) {
      return rates[static_cast<std::size_t>(arm)][blurred ? 1 : 0].at(flight);
    }));
  return mean_of(values);
}

}  // namespace

std::vector<GapCount> counts_of(const ScoredComparison& runs, const GapCell& cell, const Cut& cut) {
  std::vector<GapCount> counts;
  const Recording& recording = runs.stored.recording;
  for (std::size_t r = 0; r < runs.stored.runs.size(); ++r) {
    const StoredRun& run = runs.stored.runs[r];
    if (run.record.yardstick) continue;
    const TargetTimeline& timeline = runs.evaluations[r].targets.front();
    GapCount count{.method = run.record.method, .cell = cell};
    count.frames = recording.frames();
    count.losses = timeline.losses.size();
    count.recovered =
        static_cast<std::size_t>(std::ranges::count(timeline.losses, LossEnd::recovered, &Loss::end));
    count.held_minutes = held_minutes(timeline.states, cut, recording.period);
    count.steps = transitions(recording, run.trajectory, 0, timeline);
    count.lifetimes = tracking_lifetimes(recording, run.trajectory, timeline);
    count.answers = answers_of(run.trajectory);
    counts.push_back(std::move(count));
  }
  return counts;
}

FlightMean mean_of(const std::vector<double>& flights) {
  FlightMean mean;
  const auto n = static_cast<double>(flights.size());
  for (const double value : flights) mean.value += value / n;
  if (flights.size() < 2) return mean;
  double squares = 0;
  for (const double value : flights) squares += std::pow(value - mean.value, 2);
  const double half = student_quantile(n - 1) * std::sqrt(squares / (n * (n - 1)));
  mean.interval = Interval{mean.value - half, mean.value + half};
  return mean;
}

LossRates loss_rates(const std::vector<GapCount>& counts, const std::string& method) {
  LossRates rates;
  for (const GapCount& count : counts)
    if (count.method == method)
      rates[static_cast<std::size_t>(count.cell.arm)][count.cell.blurred ? 1 : 0].push_back(
          count.losses_per_minute());
  return rates;
}

GapEffects effects_of(const LossRates& rates) {
  const auto jump = [](const auto& at, bool paused, bool blurred) {
    return paused ? at(GapArm::gaps, blurred) - at(GapArm::pauses, blurred)
                  : at(GapArm::jumps, blurred) - at(GapArm::all_frames, blurred);
  };
  const auto pause = [](const auto& at, bool jumped, bool blurred) {
    return jumped ? at(GapArm::gaps, blurred) - at(GapArm::jumps, blurred)
                  : at(GapArm::pauses, blurred) - at(GapArm::all_frames, blurred);
  };
  const auto jump_at = [&](const auto& at, bool blurred) {
    return (jump(at, false, blurred) + jump(at, true, blurred)) / 2;
  };
  GapEffects effects;
  effects.jump =
      over_flights(rates, [&](const auto& at) { return (jump_at(at, false) + jump_at(at, true)) / 2; });
  effects.pause = over_flights(rates, [&](const auto& at) {
    double sum = 0;
    for (const bool jumped : {false, true})
      for (const bool blurred : {false, true}) sum += pause(at, jumped, blurred);
    return sum / 4;
  });
  effects.blur = over_flights(rates, [&](const auto& at) {
    double sum = 0;
    for (const GapArm arm : kGapArms) sum += at(arm, true) - at(arm, false);
    return sum / kGapArms.size();
  });
  effects.jump_with_pause = over_flights(rates, [&](const auto& at) {
    double sum = 0;
    for (const bool blurred : {false, true}) sum += jump(at, true, blurred) - jump(at, false, blurred);
    return sum / 2;
  });
  effects.jump_with_blur =
      over_flights(rates, [&](const auto& at) { return jump_at(at, true) - jump_at(at, false); });
  return effects;
}

std::vector<StepRisk> risk_by_displacement(const std::vector<Transition>& steps,
                                           const std::vector<double>& edges) {
  std::vector<StepRisk> bins(edges.size());
  for (const Transition& step : steps) {
    if (!step.displacement) continue;
    const double displacement = *step.displacement / 10;  // in tenths of D
    const auto above = std::ranges::upper_bound(edges, displacement);
    StepRisk& bin = bins[static_cast<std::size_t>(above - edges.begin()) - 1];
    ++bin.steps;
    bin.lost += step.lost ? 1 : 0;
  }
  return bins;
}

NearGap near_gaps(const std::vector<Transition>& steps, Duration period) {
  NearGap found;
  int since = 3;  // steps since the last that spanned such a gap
  for (const Transition& step : steps) {
    const auto slots = 1 + static_cast<std::int64_t>(step.recorded_slots + step.injected_slots);
    since = above_100ms(slots * period, period) ? 0 : since + 1;
    ++found.all.steps;
    found.all.lost += step.lost ? 1 : 0;
    if (since >= 3) continue;
    ++found.near.steps;
    found.near.lost += step.lost ? 1 : 0;
  }
  return found;
}

}  // namespace relock::reproduction
