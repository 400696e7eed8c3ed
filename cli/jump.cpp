// `relock jump`: how far a target may be displaced over a gap before methods lose it.

#include <fmt/format.h>

#include <opencv2/core/ocl.hpp>
#include <opencv2/core/utility.hpp>

#include "cli/flights.h"
#include "cli/jump/attempt.h"
#include "cli/jump/curve.h"
#include "cli/map/sweep.h"
#include "cli/recordings.h"
#include "cli/runs/folder.h"
#include "cli/verbs.h"
#include "core/error.h"

namespace relock {
namespace {

/// The map's flight, but a third as fast: a target is to be held easily while nothing is missing, and to be a few of its
/// sizes away after half a second.
simulator::FlightPlan jump_flight() {
  simulator::FlightPlan plan = maps::map_flight();
  plan.motion.sway_deg = 9, plan.motion.sway_hz = 0.6;
  return plan;
}

std::vector<NamedFlight> flights_of(const JumpArguments& a) {
  simulator::FlightPlan plan = a.flight ? simulator::read_flight_plan(*a.flight) : jump_flight();
  if (a.target) plan.targets.front().name = *a.target;
  if (a.exposure_ms) plan.exposure.time_ms = *a.exposure_ms;
  std::vector<NamedFlight> flights;
  for (int seed = 1; seed <= a.seeds; ++seed) {
    plan.seed = static_cast<std::uint64_t>(seed);
    flights.push_back({fmt::format("seed-{}", seed), plan});
  }
  return flights;
}

/// The recording that was asked for, or flights, which are made if they are not there.
std::vector<Sequence> sequences_of(const JumpArguments& a) {
  if (a.sequence) {
    if (a.flight || a.target || a.exposure_ms)
      throw Error("--flight, --target and --exposure are about simulated flights, and --sequence is given");
    return {open_sequence(recording_path(*a.sequence), {.labels = a.labels})};
  }
  const auto flights = flights_of(a);
  const ResultsLock lock = prepare_results(a.out);
  fly_missing(a.out, flights, a.jobs);
  std::vector<Sequence> sequences;
  for (const NamedFlight& flight : flights)
    sequences.push_back(open_sequence(flight_folder(a.out, flight.name)));
  return sequences;
}

/// Throws Error when the method reads codes, and a target has none of its kind.
void check_codes(const ChosenMethod& method, const std::vector<Sequence>& sequences) {
  for (const Sequence& sequence : sequences)
    for (const Target& target : sequence.recording.targets)
      if (!method.asked_about(target))
        throw Error(fmt::format("{} reads codes of another kind than target {} of {} has", method.text,
                                target.id, sequence.recording.name));
}

jumps::Trial trial_of(const JumpArguments& a, const Methods& methods) {
  jumps::Trial trial;
  for (const MethodSpec& spec : parse_methods(a.methods)) trial.methods.push_back(choose(methods, spec));
  trial.test.before = a.before;
  trial.clock = a.no_time_gap ? jumps::Clock::closed : jumps::Clock::kept;
  trial.sequences = sequences_of(a);
  std::size_t jumps = 0;
  for (const Sequence& sequence : trial.sequences) {
    trial.jumps.push_back(jumps_in(sequence.recording, trial.test));
    jumps += trial.jumps.back().size();
  }
  if (jumps == 0)
    throw Error(fmt::format(
        "there is no jump to try: a recording needs {} frames in a row whose target is labelled, visible at "
        "the end and can be started on at the beginning",
        trial.test.window()));
  for (const ChosenMethod& method : trial.methods) check_codes(method, trial.sequences);
  return trial;
}

}  // namespace

int jump(const JumpArguments& arguments, const Methods& methods) {
  cv::setNumThreads(1);  // the same answers on any machine
  cv::ocl::setUseOpenCL(false);
  const jumps::Trial trial = trial_of(arguments, methods);
  const auto curves = jumps::curves_of(trial, jumps::try_all(trial, arguments.jobs));
  if (arguments.plot) draw(jumps::plot_of(curves, trial), *arguments.plot);
  fmt::print("{}", arguments.json ? json_text(jumps::json_of(curves, trial)) : jumps::text_of(curves, trial));
  return 0;
}

}  // namespace relock
