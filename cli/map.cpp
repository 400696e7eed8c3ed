// `relock map`: where tracking beats detection, and where detection beats tracking.

#include <fmt/format.h>

#include <chrono>
#include <opencv2/core/ocl.hpp>
#include <opencv2/core/utility.hpp>
#include <set>

#include "cli/files.h"
#include "cli/map/answer.h"
#include "cli/map/draw.h"
#include "cli/map/estimate.h"
#include "cli/map/measure.h"
#include "cli/map/sweep.h"
#include "cli/runs/folder.h"
#include "cli/runs/missing.h"
#include "cli/verbs.h"
#include "core/error.h"

namespace relock {
namespace {

using maps::Across;
using maps::SweepPlan;

Across across_of(const std::string& axes) {
  const std::size_t comma = axes.find(',');
  if (comma == std::string::npos || axes.substr(comma) != ",blur")
    throw Error(fmt::format("--axes {} is none; they are gap,blur, rate,blur and size,blur", axes));
  return maps::parse_across(axes.substr(0, comma));
}

/// Small enough for a first look: some of the default's rows and columns, two seconds, three seeds.
void make_quick(SweepPlan& plan) {
  plan.exposures_ms = {2, 20, 33};
  plan.columns = plan.across == Across::gap    ? std::vector<double>{1, 2, 4, 8}
                 : plan.across == Across::rate ? std::vector<double>{5, 10, 15, 30}
                                               : std::vector<double>{20, 40, 80};
  plan.seeds = 3;
  plan.flight.duration_s = 2;
}

SweepPlan plan_of(const MapArguments& a) {
  SweepPlan plan;
  plan.across = across_of(a.axes);
  plan.columns = maps::default_columns(plan.across);
  plan.flight = a.flight ? simulator::read_flight_plan(*a.flight) : maps::map_flight();
  if (a.quick) make_quick(plan);
  if (!a.columns.empty()) plan.columns = a.columns;
  if (!a.exposures_ms.empty()) plan.exposures_ms = a.exposures_ms;
  plan.gap_share = a.gap_share.value_or(plan.gap_share);
  plan.seeds = a.seeds.value_or(plan.seeds);
  plan.flight.duration_s = a.duration_s.value_or(plan.flight.duration_s);
  if (a.target) plan.flight.targets.front().name = *a.target;
  plan.methods = parse_methods(a.methods);
  plan.out = a.out;
  maps::check_sweep(plan);
  return plan;
}

/// Faults that are better told before an hour of work: methods that do not exist, or of one class only.
void check_methods(const SweepPlan& plan, const MapArguments& arguments, const Methods& methods) {
  std::set<std::string> names[2];  // trackers, detectors
  for (const MethodSpec& spec : plan.methods) {
    choose(methods, spec);
    if (!is_yardstick(spec.name)) names[is_detection(methods, spec) ? 1 : 0].insert(spec.text());
  }
  const auto check = [](const std::set<std::string>& there, const std::optional<std::string>& asked,
                        const char* kind) {
    if (there.empty())
      throw Error(fmt::format("a map needs a tracker and a detector, and --methods names no {}", kind));
    if (asked && !there.contains(*asked))
      throw Error(fmt::format("--{0} {1}: the map has no {0} of this name; it must be one of --methods", kind,
                              *asked));
  };
  check(names[0], arguments.tracker, "tracker");
  check(names[1], arguments.detector, "detector");
}

void write_map(const SweepPlan& plan, const maps::MeasuredMap& map, const maps::Answer& answer) {
  write_file(plan.out / "map.csv", maps::csv_of(map, answer));
  write_file(plan.out / "map.json", maps::json_of(map, answer));
  write_file(plan.out / "map.svg", maps::svg_of(map, answer));
  write_file(plan.out / "map.png", maps::png_of(map, answer));
}

}  // namespace

int map(const MapArguments& arguments, const Methods& methods) {
  cv::setNumThreads(1);  // the same bytes on any machine
  cv::ocl::setUseOpenCL(false);
  const SweepPlan plan = plan_of(arguments);
  check_methods(plan, arguments, methods);
  if (arguments.dry_run) {
    fmt::print("{}", maps::estimate_of(plan, methods, arguments.jobs));
    return 0;
  }
  const ResultsLock lock = prepare_results(plan.out);
  maps::fly_missing(plan, arguments.jobs);
  const maps::SweepMatrix sweep = maps::sweep_matrix(plan, maps::flights_of(plan), methods);
  const int status = make_missing_runs(sweep.matrix, arguments.jobs);
  if (status > 1) return status;
  const maps::MeasuredMap measured = maps::measure(plan, sweep, methods);
  const maps::Answer answer = maps::answer(measured, arguments.tracker, arguments.detector);
  write_map(plan, measured, answer);
  fmt::print("{}\nThe map is in {}: map.svg, map.png, map.csv and map.json\n",
             maps::text_of(measured, answer), plan.out.string());
  return status;
}

}  // namespace relock
