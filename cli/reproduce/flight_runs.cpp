#include "cli/reproduce/flight_runs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "cli/runs/folder.h"
#include "cli/runs/missing.h"
#include "core/error.h"

namespace relock::reproduction {
namespace {

bool is_there(const Methods& methods, const MethodSpec& spec) {
  return is_combination(spec.name) || methods.detectors.find(spec.name) || methods.trackers.find(spec.name);
}

std::vector<MethodSpec> those_there(const std::vector<std::string>& wanted, const Methods& methods) {
  std::vector<MethodSpec> there;
  for (const std::string& method : wanted) {
    const MethodSpec spec = parse_methods(method).front();
    if (is_there(methods, spec)) there.push_back(spec);
  }
  if (there.empty()) throw Error(fmt::format("none of the methods {} is known", fmt::join(wanted, ", ")));
  return there;
}

/// The comparison that each recording's runs belong to.
std::vector<ScoredComparison> read_runs_of(const Matrix& matrix) {
  std::vector<ScoredComparison> all;
  for (std::size_t c = 0; c < matrix.conditions.size(); ++c) {
    const auto run = std::ranges::find(matrix.runs, c, &PlannedRun::condition);
    StoredComparison stored = std::move(read_results(run->folder.parent_path()).front());
    std::erase_if(stored.runs, [&](const StoredRun& there) {
      return std::ranges::none_of(
          matrix.runs, [&](const PlannedRun& asked) { return asked.method.text == there.record.method; });
    });
    all.push_back(scored(std::move(stored), Gate{}));
  }
  return all;
}

}  // namespace

std::vector<ScoredComparison> run_on(const Settings& settings,
                                     const std::vector<std::filesystem::path>& recordings,
                                     const std::vector<std::string>& wanted, Protocol protocol,
                                     const Methods& methods) {
  Plan plan;
  for (const std::filesystem::path& recording : recordings) plan.sequences.push_back({recording});
  plan.methods = those_there(wanted, methods);
  plan.protocols = {protocol};
  plan.out = settings.out / "runs";
  const Matrix matrix = multiply_out(plan, methods);
  const ResultsLock lock = prepare_results(plan.out);
  if (make_missing_runs(matrix, settings.jobs) > 1)
    throw Error("the runs on the flights are not complete; the same command goes on from there");
  return read_runs_of(matrix);
}

std::vector<ScoredComparison> fly_and_run(const Settings& settings, const std::vector<NamedFlight>& flights,
                                          const std::vector<std::string>& wanted, const Methods& methods) {
  fly_missing(settings.out, flights, settings.jobs);
  std::vector<std::filesystem::path> recordings;
  for (const NamedFlight& flight : flights) recordings.push_back(flight_folder(settings.out, flight.name));
  return run_on(settings, recordings, wanted, Protocol::detect, methods);
}

}  // namespace relock::reproduction
