#include "cli/jump/curve.h"

#include <fmt/format.h>

#include "cli/table.h"
#include "eval/statistics/interval.h"

namespace relock::jumps {
namespace {

void count(Outcome outcome, LossRate& rate) {
  if (outcome == Outcome::not_held) {
    ++rate.not_held;
    return;
  }
  ++rate.tried;
  rate.lost += lost(outcome);
  rate.declared += outcome == Outcome::declared;
  rate.failed += outcome == Outcome::failed;
}

std::string bin_text(const JumpTest& test, std::size_t bin) {
  return fmt::format("{:g} to {:g}", test.edges[bin], test.edges[bin + 1]);
}

std::string rate_text(const LossRate& rate) {
  if (rate.tried == 0) return "n/a";
  const Interval percent = rate.interval();
  return fmt::format("{:.0f} [{:.0f}, {:.0f}] of {}", 100.0 * rate.lost / rate.tried, percent.low,
                     percent.high, rate.tried);
}

std::string losses_sentence(const Curve& curve) {
  LossRate all;
  for (const LossRate& rate : curve.bins)
    all.tried += rate.tried, all.lost += rate.lost, all.declared += rate.declared, all.failed += rate.failed,
        all.not_held += rate.not_held;
  std::string text = fmt::format("  {}: {} of {} losses were declared", curve.method, all.declared, all.lost);
  if (all.failed > 0) text += fmt::format(", in {} the method failed", all.failed);
  if (all.not_held > 0) text += fmt::format("; {} jumps left out, not held before the gap", all.not_held);
  return text + "\n";
}

}  // namespace

Interval LossRate::interval() const {
  const Interval share = wilson(lost, tried);
  return {100 * share.low, 100 * share.high};
}

std::vector<Curve> curves_of(const Trial& trial, const Outcomes& outcomes) {
  std::vector<Curve> curves;
  for (std::size_t method = 0; method < trial.methods.size(); ++method) {
    Curve curve{trial.methods[method].text, std::vector<LossRate>(trial.test.bins())};
    for (std::size_t sequence = 0; sequence < trial.sequences.size(); ++sequence)
      for (std::size_t rank = 0; rank < trial.jumps[sequence].size(); ++rank)
        count(outcomes[method][sequence][rank], curve.bins[trial.jumps[sequence][rank].bin]);
    curves.push_back(std::move(curve));
  }
  return curves;
}

std::string text_of(const std::vector<Curve>& curves, const Trial& trial) {
  std::vector<std::string> header{"jump, D"};
  for (const Curve& curve : curves) header.push_back(curve.method);
  Table table(header);
  for (std::size_t bin = 0; bin < trial.test.bins(); ++bin) {
    std::vector<std::string> row{bin_text(trial.test, bin)};
    for (const Curve& curve : curves) row.push_back(rate_text(curve.bins[bin]));
    table.add(row);
  }
  std::string text = fmt::format(
      "Jumps after which the target is not held, %: started, {} frames, a gap of up to {}{}, {} "
      "frames\n\n{}\n",
      trial.test.before, trial.test.most_missing,
      trial.clock == Clock::closed ? ", without a gap in time" : "", trial.test.after, table.text(2));
  for (const Curve& curve : curves) text += losses_sentence(curve);
  return text +
         fmt::format(
             "  A jump is the displacement of the target's centre over the gap, in its size D; brackets "
             "are Wilson's 95 %.\n");
}

Json json_of(const std::vector<Curve>& curves, const Trial& trial) {
  Json methods = Json::array();
  for (const Curve& curve : curves) {
    Json bins = Json::array();
    for (std::size_t bin = 0; bin < curve.bins.size(); ++bin) {
      const LossRate& rate = curve.bins[bin];
      const std::optional<Interval> percent = rate.tried > 0 ? std::optional(rate.interval()) : std::nullopt;
      bins.push_back({{"from", trial.test.edges[bin]},
                      {"to", trial.test.edges[bin + 1]},
                      {"tried", rate.tried},
                      {"lost", rate.lost},
                      {"lost_percent_interval", interval(percent)},
                      {"declared", rate.declared},
                      {"failed", rate.failed},
                      {"not_held_before", rate.not_held}});
    }
    methods.push_back({{"method", curve.method}, {"bins", bins}});
  }
  Json recordings = Json::array();
  for (const Sequence& sequence : trial.sequences) recordings.push_back(sequence.recording.name);
  return {{"recordings", recordings},
          {"frames_before", trial.test.before},
          {"most_missing", trial.test.most_missing},
          {"frames_after", trial.test.after},
          {"gap_in_time", trial.clock == Clock::kept},
          {"methods", methods}};
}

Plot plot_of(const std::vector<Curve>& curves, const Trial& trial) {
  Plot plot{.title = "Loss by the displacement over a gap",
            .x = {.title = "displacement, target sizes D", .low = 0, .high = trial.test.edges.back()},
            .y = {.title = "not held afterwards, %", .low = 0, .high = 100},
            .curves = {}};
  for (const Curve& curve : curves) {
    PlotCurve drawn{.name = curve.method, .points = {}};
    for (std::size_t bin = 0; bin < curve.bins.size(); ++bin) {
      const LossRate& rate = curve.bins[bin];
      if (rate.tried == 0) continue;
      drawn.points.push_back({0.5 * (trial.test.edges[bin] + trial.test.edges[bin + 1]),
                              100.0 * rate.lost / rate.tried, rate.interval()});
    }
    plot.curves.push_back(std::move(drawn));
  }
  return plot;
}

}  // namespace relock::jumps
