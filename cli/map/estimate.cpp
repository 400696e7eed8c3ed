#include "cli/map/estimate.h"

#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <chrono>

#include "cli/map/measure.h"
#include "cli/runs/pool.h"
#include "cli/runs/worker.h"
#include "core/error.h"

namespace relock::maps {
namespace {

namespace fs = std::filesystem;

constexpr double kTrial_s = 0.5;  // of flight
constexpr double kBesideFrames_s =
    0.1;  // that a run takes whatever its frames: a process, its files, its scores

class TemporaryFolder {
 public:
  TemporaryFolder() : path_((fs::temp_directory_path() / "relock-map-XXXXXX").string()) {
    if (!mkdtemp(path_.data())) throw Error(fmt::format("{} cannot be made", path_));
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  fs::path path() const { return path_; }

 private:
  std::string path_;
};

/// The middle cell alone, shortly.
SweepPlan trial_of(SweepPlan plan, const fs::path& folder) {
  plan.exposures_ms = {plan.exposures_ms[plan.exposures_ms.size() / 2]};
  plan.columns = {plan.columns[plan.columns.size() / 2]};
  plan.seeds = 1;
  plan.flight.duration_s = std::min(kTrial_s, plan.flight.duration_s);
  plan.out = folder;
  return plan;
}

double frames_of(const SweepPlan& plan) { return plan.flight.duration_s * plan.flight.camera.rate_hz; }

struct Pace {
  double flying = 0;   // s a frame
  double running = 0;  // s a frame, all methods together
};
Pace pace_of(const SweepPlan& plan, const Methods& methods) {
  const TemporaryFolder folder;
  const SweepPlan trial = trial_of(plan, folder.path());
  const auto begun = std::chrono::steady_clock::now();
  fly_missing(trial, 1);
  const std::chrono::duration<double> flown = std::chrono::steady_clock::now() - begun;
  Pace pace{flown.count() / frames_of(trial), 0};
  const SweepMatrix sweep = sweep_matrix(trial, flights_of(trial), methods);
  for (const PlannedRun& run : sweep.matrix.runs)
    pace.running += trial_seconds_per_frame(sweep.matrix, run).value_or(0);
  return pace;
}

/// Of a sweep's runs, as they would be in their folders.
std::size_t runs_there(const SweepPlan& plan, const std::vector<PlannedFlight>& flown,
                       const Methods& methods) {
  if (flown.empty()) return 0;
  const SweepMatrix sweep = sweep_matrix(plan, flown, methods);
  return static_cast<std::size_t>(std::count_if(sweep.matrix.runs.begin(), sweep.matrix.runs.end(),
                                                [](const PlannedRun& run) { return run.there; }));
}

}  // namespace

std::string estimate_of(const SweepPlan& plan, const Methods& methods, int jobs) {
  std::vector<PlannedFlight> flown;
  const auto flights = flights_of(plan);
  for (const PlannedFlight& flight : flights)
    if (is_flown(plan, flight)) flown.push_back(flight);
  const std::size_t cells = plan.exposures_ms.size() * plan.columns.size();
  const std::size_t runs = cells * static_cast<std::size_t>(plan.seeds) * plan.methods.size();
  const std::size_t there = runs_there(plan, flown, methods);
  const Pace pace = pace_of(plan, methods);
  const double to_fly = static_cast<double>(flights.size() - flown.size());
  const double to_run = static_cast<double>(runs - there);
  const double seconds =
      to_fly * frames_of(plan) * pace.flying +
      to_run * (frames_of(plan) * pace.running / static_cast<double>(plan.methods.size()) + kBesideFrames_s);
  return fmt::format(
      "{} cells of {} seeds: {} flights of {:g} s, {} of them there already; {} runs, {} of them there "
      "already\nThe rest takes about {} with --jobs {}, by a trial of the middle cell\n",
      cells, plan.seeds, flights.size(), plan.flight.duration_s, flown.size(), runs, there,
      spoken_time(seconds / jobs), jobs);
}

}  // namespace relock::maps
