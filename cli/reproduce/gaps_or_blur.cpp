#include "cli/reproduce/gaps_or_blur.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/reproduce/gap_flights.h"
#include "cli/reproduce/gap_words.h"
#include "eval/statistics/kaplan_meier.h"

namespace relock::reproduction {
namespace {

const std::string kGapAware = "gap-aware(blut,rate_hz=30)";

/// The tracker of the paper, those like it, a quick one, and one that knows of time: started again after each loss.
const std::vector<std::string> kStartedAgain{"blut", "l1", "ivt", "kcf", kGapAware};
/// Started once: which of its losses does a method end itself? With a detector it takes as long as all others together.
const std::vector<std::string> kStartedOnce{"blut", "l1", kGapAware, "hybrid(ring,blut)"};
const std::vector<std::string> kQuickStartedAgain{"blut", "kcf"}, kQuickStartedOnce{"blut"};

/// Displacements from frame to frame, D, as `relock jump` tells them apart.
const std::vector<double> kEdges{0, 0.25, 0.5, 0.75, 1, 1.5};

/// In the order in which they were run.
std::vector<std::string> methods_in(const std::vector<GapCount>& counts) {
  std::vector<std::string> methods;
  for (const std::vector<std::string>& wanted : {kStartedAgain, kStartedOnce})
    for (const std::string& method : wanted)
      if (std::ranges::find(methods, method) == methods.end() &&
          std::ranges::find(counts, method, &GapCount::method) != counts.end())
        methods.push_back(method);
  return methods;
}

Table rate_table(const std::vector<GapCount>& counts, bool blurred) {
  std::vector<std::string> header{blurred ? "blurred: losses per minute held"
                                          : "sharp: losses per minute held"};
  for (const GapArm arm : kGapArms) header.emplace_back(to_string(arm));
  Table table(header);
  for (const std::string& method : methods_in(counts)) {
    std::vector<std::string> row{method};
    const LossRates rates = loss_rates(counts, method);
    for (const auto& arm : rates) row.push_back(mean_cell(mean_of(arm[blurred ? 1 : 0])));
    table.add(row);
  }
  return table;
}

Table effect_table(const std::vector<GapCount>& counts) {
  Table table({"what adds to them", "jump", "pause", "blur", "jump with pause", "jump with blur"});
  for (const std::string& method : methods_in(counts)) {
    const GapEffects effects = effects_of(loss_rates(counts, method));
    table.add({method, mean_cell(effects.jump), mean_cell(effects.pause), mean_cell(effects.blur),
               mean_cell(effects.jump_with_pause), mean_cell(effects.jump_with_blur)});
  }
  return table;
}

/// Of the blurred flights of an arm.
std::vector<Transition> steps_of(const std::vector<GapCount>& counts, const std::string& method, GapArm arm) {
  std::vector<Transition> steps;
  for (const GapCount* count : blurred(counts, method, arm))
    steps.insert(steps.end(), count->steps.begin(), count->steps.end());
  return steps;
}

std::string risk_cell(const StepRisk& risk) {
  if (risk.steps == 0) return "n/a";
  return fmt::format("{:.1f} of {}", 100.0 * static_cast<double>(risk.lost) / static_cast<double>(risk.steps),
                     risk.steps);
}

std::string edge_title(std::size_t bin) {
  return bin + 1 < kEdges.size() ? fmt::format("{:g} to {:g} D", kEdges[bin], kEdges[bin + 1])
                                 : fmt::format("{:g} D on", kEdges[bin]);
}

Table risk_table(const std::vector<GapCount>& counts) {
  std::vector<std::string> header{"blurred: lost at a step of, %"};
  for (std::size_t bin = 0; bin < kEdges.size(); ++bin) header.push_back(edge_title(bin));
  Table table(header);
  for (const std::string& method : methods_in(counts))
    for (const GapArm arm : {GapArm::jumps, GapArm::gaps}) {
      std::vector<std::string> row{fmt::format("{}, {}", method, to_string(arm))};
      for (const StepRisk& risk : risk_by_displacement(steps_of(counts, method, arm), kEdges))
        row.push_back(risk_cell(risk));
      table.add(row);
    }
  return table;
}

Table once_table(const std::vector<GapCount>& counts) {
  Table table({"started once, gaps", "flights", "losses", "recovered", "flights lost for good"});
  for (const std::string& method : methods_in(counts)) {
    std::size_t flights = 0, losses = 0, recovered = 0, for_good = 0;
    for (const GapCount& count : counts) {
      if (count.method != method || count.cell.arm != GapArm::gaps) continue;
      ++flights, losses += count.losses, recovered += count.recovered;
      for_good += count.losses > count.recovered ? 1 : 0;
    }
    table.add({method, fmt::format("{}", flights), fmt::format("{}", losses), fmt::format("{}", recovered),
               fmt::format("{}", for_good)});
  }
  return table;
}

/// How long a blurred flight is held, in frames shown after a start.
Plot survival_plot(const std::vector<GapCount>& counts, const std::string& method) {
  Plot plot{.title = fmt::format("How long {} holds a blurred ring that it was given", method),
            .x = {.title = "frames after the start", .low = 0.0},
            .y = {.title = "share that still holds", .low = 0.0, .high = 1.0}};
  for (const GapArm arm : kGapArms) {
    std::vector<Lifetime> lifetimes;
    for (const TrackingLifetime& one : lifetimes_of(counts, method, arm))
      lifetimes.push_back({static_cast<double>(one.frames), one.lost});
    if (lifetimes.empty()) continue;
    const KaplanMeier survival(lifetimes);
    PlotCurve curve{.name = std::string(to_string(arm)), .points = {}, .style = CurveStyle::line};
    const double until = std::min(survival.follow_up(), 300.0);
    for (double frame = 0; frame <= until; ++frame) curve.points.push_back({frame, survival.survival(frame)});
    plot.curves.push_back(std::move(curve));
  }
  return plot;
}

Json figures_of(const GapCounts& counts) {
  Json methods = Json::array();
  for (const std::string& method : methods_in(counts.reset)) {
    const LossRates rates = loss_rates(counts.reset, method);
    Json arms = Json::array();
    for (const GapArm arm : kGapArms)
      for (const bool blurred : {false, true})
        arms.push_back({{"arm", to_string(arm)},
                        {"blurred", blurred},
                        {"losses_per_minute_held",
                         json_of(mean_of(rates[static_cast<std::size_t>(arm)][blurred ? 1 : 0]))},
                        {"flights", rates[static_cast<std::size_t>(arm)][blurred ? 1 : 0]}});
    methods.push_back({{"method", method},
                       {"arms", arms},
                       {"effects", json_of(effects_of(rates))},
                       {"survival_gaps_blurred",
                        sentence(tracking_survival(lifetimes_of(counts.reset, method, GapArm::gaps)))}});
  }
  return {{"gaps", kGapPattern}, {"methods", methods}};
}

}  // namespace

Finding finding_of_gaps(const GapCounts& counts) {
  Finding finding;
  finding.id = "gaps-or-blur";
  finding.title = "what trackers lose a ring at, by injection";
  finding.tables = {rate_table(counts.reset, false), rate_table(counts.reset, true),
                    effect_table(counts.reset), risk_table(counts.reset), once_table(counts.once)};
  finding.sentences = gap_sentences(counts, methods_in(counts.reset), methods_in(counts.once));
  for (const std::string& method : methods_in(counts.reset))
    finding.plots.emplace_back(survival_plot(counts.reset, method));
  finding.figures = figures_of(counts);
  return finding;
}

std::vector<Finding> gaps_or_blur(const Settings& settings, const Methods& methods) {
  const auto flights = gap_flights(settings);
  const auto arms = fly_and_cut(settings, flights, {kGapArms.begin(), kGapArms.end()});
  std::vector<CutFlight> missing;
  for (const CutFlight& cut : arms)
    if (cut.cell.blurred && jumps(cut.cell.arm)) missing.push_back(cut);
  GapCounts counts;
  counts.reset = run_and_count(settings, arms, settings.quick ? kQuickStartedAgain : kStartedAgain,
                               Protocol::reset, methods);
  counts.once = run_and_count(settings, missing, settings.quick ? kQuickStartedOnce : kStartedOnce,
                              Protocol::once, methods);
  counts.period = period_of(flights.front().flight.plan.camera.rate_hz);
  return {finding_of_gaps(counts)};
}

}  // namespace relock::reproduction
