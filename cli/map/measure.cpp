#include "cli/map/measure.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/flights.h"
#include "cli/runs/folder.h"
#include "core/error.h"
#include "eval/scores/scores.h"

namespace relock::maps {
namespace {

Plan plan_of_runs(const SweepPlan& plan, const PlannedFlight& flight) {
  Plan runs;
  runs.sequences = {{folder_of(plan, flight)}};
  runs.methods = plan.methods;
  runs.gaps.clear();
  for (std::size_t column = 0; column < plan.columns.size(); ++column)
    if (!flight.column || *flight.column == column) runs.gaps.push_back(gaps_of(plan, column));
  runs.seeds = {flight.seed};
  runs.out = plan.out / "runs";
  return runs;
}

bool asked_for(const SweepPlan& plan, const PlannedRun& run) {
  return std::any_of(plan.methods.begin(), plan.methods.end(),
                     [&](const MethodSpec& spec) { return spec.text() == run.method.text; });
}

/// Appends the runs of one flight.
void append(SweepMatrix& sweep, Matrix&& flight) {
  Matrix& all = sweep.matrix;
  const std::size_t first_sequence = all.sequences.size(), first_condition = all.conditions.size();
  for (Sequence& sequence : flight.sequences) all.sequences.push_back(std::move(sequence));
  for (Condition& condition : flight.conditions) {
    condition.sequence += first_sequence;
    all.conditions.push_back(std::move(condition));
  }
  for (PlannedRun& run : flight.runs) {
    run.condition += first_condition;
    all.runs.push_back(std::move(run));
  }
}

MethodClass class_of(const MethodSpec& spec, const Methods& methods) {
  if (is_yardstick(spec.name)) return MethodClass::yardstick;
  return is_detection(methods, spec) ? MethodClass::detector : MethodClass::tracker;
}

template <class Cell>
Grid<Cell> grid(const SweepPlan& plan, const Cell& cell) {
  return Grid<Cell>(plan.exposures_ms.size(), std::vector<Cell>(plan.columns.size(), cell));
}

/// Of the flights of every row; each is looked at once.
std::vector<Blur> blur_of_rows(const SweepPlan& plan, const SweepMatrix& sweep) {
  std::vector<Blur> rows(plan.exposures_ms.size());
  std::vector<double> frames(rows.size());
  std::vector<bool> seen(sweep.matrix.sequences.size());
  for (std::size_t c = 0; c < sweep.places.size(); ++c) {
    const std::size_t sequence = sweep.matrix.conditions[c].sequence, row = sweep.places[c].row;
    if (seen[sequence]) continue;
    seen[sequence] = true;
    for (const TargetTruth& truth : sweep.matrix.sequences[sequence].recording.truth) {
      if (truth.label != Label::visible || !truth.blur) continue;
      const double length = norm(*truth.blur);
      rows[row].mean_px += length;
      rows[row].mean_percent += 100 * length / truth.size_px();
      frames[row] += 1;
    }
  }
  for (std::size_t row = 0; row < rows.size(); ++row)
    rows[row].mean_px /= frames[row], rows[row].mean_percent /= frames[row];
  return rows;
}

/// The stored runs of one condition, whatever methods are there.
std::vector<StoredRun> runs_of(const SweepMatrix& sweep, std::size_t condition) {
  for (const PlannedRun& run : sweep.matrix.runs)
    if (run.condition == condition) return read_results(run.folder.parent_path()).front().runs;
  return {};
}

}  // namespace

void fly_missing(const SweepPlan& plan, int jobs) {
  std::vector<NamedFlight> flights;
  for (PlannedFlight& flight : flights_of(plan)) flights.push_back({flight.name, std::move(flight.plan)});
  relock::fly_missing(plan.out, flights, jobs);
}

SweepMatrix sweep_matrix(const SweepPlan& plan, const std::vector<PlannedFlight>& flights,
                         const Methods& methods) {
  SweepMatrix sweep;
  for (const PlannedFlight& flight : flights) {
    Matrix runs = multiply_out(plan_of_runs(plan, flight), methods);
    if (!runs.left_out.empty()) throw Error(runs.left_out.front());
    std::erase_if(runs.runs, [&](const PlannedRun& run) { return !asked_for(plan, run); });
    for (std::size_t c = 0; c < runs.conditions.size(); ++c)
      sweep.places.push_back(
          {flight.row, flight.column.value_or(c), static_cast<std::size_t>(flight.seed - 1)});
    append(sweep, std::move(runs));
  }
  return sweep;
}

MeasuredMap measure(const SweepPlan& plan, const SweepMatrix& sweep, const Methods& methods) {
  const auto seeds = static_cast<std::size_t>(plan.seeds);
  MeasuredMap map{plan, blur_of_rows(plan, sweep), {}, {}};
  for (const MethodSpec& spec : plan.methods) {
    map.methods.push_back({spec.text(), class_of(spec, methods),
                           grid(plan, LockedTime{std::vector<double>(seeds), std::vector<double>(seeds)})});
    map.ceilings.push_back(grid(plan, std::optional<double>()));
  }
  std::vector<Grid<double>> votes(map.methods.size(), grid(plan, 0.0));  // flights that have a ceiling
  for (std::size_t c = 0; c < sweep.places.size(); ++c) {
    const auto [row, column, seed] = sweep.places[c];
    const Recording& recording = sweep.matrix.sequences[sweep.matrix.conditions[c].sequence].recording;
    for (const StoredRun& run : runs_of(sweep, c)) {
      for (std::size_t m = 0; m < map.methods.size(); ++m) {
        if (map.methods[m].name != run.record.method) continue;
        const Scores scores =
            score(recording, run.trajectory, evaluate(recording, run.trajectory, Gate{})).pooled;
        LockedTime& cell = map.methods[m].cells[row][column];
        cell.locked_s[seed] = scores.locked_s, cell.visible_s[seed] = scores.visible_s;
        if (!scores.locked_share_ceiling) continue;
        // The mean so far, of those that have one.
        std::optional<double>& ceiling = map.ceilings[m][row][column];
        const double before = ceiling.value_or(0), n = ++votes[m][row][column];
        ceiling = before + (*scores.locked_share_ceiling - before) / n;
      }
    }
  }
  return map;
}

}  // namespace relock::maps
