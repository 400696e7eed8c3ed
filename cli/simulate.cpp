// `relock simulate`: flights whose every frame knows the truth.

#include <fmt/format.h>

#include <algorithm>
#include <opencv2/core/utility.hpp>

#include "cli/print/targets.h"
#include "cli/terminal.h"
#include "cli/verbs.h"
#include "core/error.h"
#include "sequences/simulator/canvas_plan.h"
#include "sequences/simulator/flight.h"
#include "sequences/simulator/stills_plan.h"

namespace relock {
namespace {

using simulator::FlightPlan;

constexpr double kAnySize_m = 0.15;  // of targets where the plan says how large they are in the picture

int list_presets() {
  for (const simulator::FlightPreset& preset : simulator::flight_presets())
    fmt::print("{:<10} {}\n", preset.name, preset.sentence);
  fmt::print(
      "\n`relock simulate --preset NAME --show` prints every quantity of one, as the plan file that makes "
      "it\n");
  return 0;
}

FlightPlan plan_of(const SimulateArguments& a) {
  FlightPlan plan =
      a.plan ? simulator::read_flight_plan(*a.plan) : simulator::flight_preset(a.preset.value_or("ardrone"));
  if (!a.targets.empty()) plan.targets.clear();
  for (const std::string& name : a.targets) plan.targets.push_back({.name = name});
  plan.seed = a.seed.value_or(plan.seed);
  plan.duration_s = a.duration_s.value_or(plan.duration_s);
  plan.timing.gaps = a.gaps.value_or(plan.timing.gaps);
  simulator::check_flight_plan(plan);
  return plan;
}

void print_summary(const SimulateArguments& a, const FlightPlan& plan,
                   const simulator::FlightSummary& flown) {
  fmt::print(
      "{}: {} frames of {:g}x{:g}, {:g} s at {:g} Hz{}; over an exposure things move {:.1f} px on average\n",
      a.out->string(), flown.frames, plan.camera.width, plan.camera.height, plan.duration_s,
      plan.camera.rate_hz, flown.lost > 0 ? fmt::format(", {} lost by {}", flown.lost, plan.timing.gaps) : "",
      flown.mean_motion_px);
  if (flown.capped > 0)
    fmt::print(
        "On {} frames {} sub-exposures did not do for steps of {:g} px; the coarsest step is {:.1f} px "
        "(truth.csv has "
        "all; exposure.most_steps in a plan allows more)\n",
        flown.capped, plan.exposure.most_steps, plan.exposure.step_px, flown.coarsest_step_px);
}

bool wants_canvas(const SimulateArguments& a) {
  return a.plan ? simulator::is_canvas_file(*a.plan) : a.preset == "canvas";
}

int make_canvas(const SimulateArguments& a) {
  simulator::CanvasFile canvas = a.plan ? simulator::read_canvas_file(*a.plan) : simulator::CanvasFile{};
  if (a.targets.size() > 1) throw Error("a canvas shows one target");
  if (a.duration_s || a.gaps || a.preview)
    throw Error("a canvas has no time: leave out --duration, --gaps and --preview");
  if (!a.targets.empty()) canvas.target = a.targets.front();
  canvas.seed = a.seed.value_or(canvas.seed);
  const std::string text = simulator::canvas_file_text(canvas);
  if (a.show) {
    fmt::print("{}", text);
    return 0;
  }
  if (!a.out) throw Error("where the pictures go is missing: --out FOLDER");
  simulator::write_canvas(*a.out, canvas.plan, print_target(canvas.target, kAnySize_m), canvas.seed, text);
  fmt::print("{}: {} pictures of {} on {}x{}\n", a.out->string(), simulator::canvas_pictures(canvas.plan),
             canvas.target, canvas.plan.canvas_px, canvas.plan.canvas_px);
  return 0;
}

bool wants_stills(const SimulateArguments& a) {
  return a.plan ? simulator::is_stills_file(*a.plan) : a.preset == "stills";
}

int make_stills(const SimulateArguments& a) {
  simulator::StillsFile stills = a.plan ? simulator::read_stills_file(*a.plan) : simulator::StillsFile{};
  if (a.duration_s || a.gaps || a.preview)
    throw Error("stills have no time: leave out --duration, --gaps and --preview");
  if (!a.targets.empty()) stills.targets = a.targets;
  stills.seed = a.seed.value_or(stills.seed);
  const std::string text = simulator::stills_file_text(stills);
  if (a.show) {
    fmt::print("{}", text);
    return 0;
  }
  if (!a.out) throw Error("where the pictures go is missing: --out FOLDER");
  if (stills.stills < 1 || stills.stills > 1000000) throw Error("stills must be from 1 to 1000000");
  std::vector<PrintedTarget> targets;
  for (const std::string& name : stills.targets) targets.push_back(print_target(name, kAnySize_m));
  cv::setNumThreads(1);  // pictures are small: threads cost more than they save
  simulator::write_stills(*a.out, stills.plan, targets, static_cast<std::size_t>(stills.stills), stills.seed,
                          text);
  fmt::print("{}: {} stills of {}x{} of {}\n", a.out->string(), stills.stills, stills.plan.picture.width,
             stills.plan.picture.height, fmt::join(stills.targets, ", "));
  return 0;
}

}  // namespace

int simulate(const SimulateArguments& arguments) {
  if (arguments.list) return list_presets();
  if (arguments.plan && arguments.preset) throw Error("a plan names its own preset; leave --preset out");
  if (wants_canvas(arguments)) return make_canvas(arguments);
  if (wants_stills(arguments)) return make_stills(arguments);
  const FlightPlan plan = plan_of(arguments);
  if (arguments.show) {
    fmt::print("{}", simulator::flight_plan_text(plan));
    return 0;
  }
  if (!arguments.out) throw Error("where the flight goes is missing: --out FOLDER");
  cv::setNumThreads(1);  // the frames are made in parallel, not their parts
  Progress progress("simulating", simulator::frames_of(plan));
  simulator::FlightOptions options;
  options.jobs = arguments.jobs;
  options.preview = arguments.preview;
  options.progress = [&](std::int64_t frames) { progress.done(frames); };
  const auto flown = simulator::fly(plan, print_target, *arguments.out, options);
  print_summary(arguments, plan, flown);
  return 0;
}

}  // namespace relock
