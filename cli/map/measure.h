#pragma once

#include "cli/map/sweep.h"
#include "cli/program.h"
#include "cli/runs/matrix.h"

namespace relock::maps {

/// Flies what is not there yet. Every flight is there whole or not at all.
void fly_missing(const SweepPlan& plan, int jobs);

/// The runs of a sweep, and to which cell each condition belongs.
struct SweepMatrix {
  Matrix matrix;
  struct Place {
    std::size_t row, column, seed;  ///< seeds counted from 0
  };
  std::vector<Place> places;  ///< of every condition
};
/// Yardsticks are left out unless they are among the plan's methods. Throws Error like `multiply_out`.
SweepMatrix sweep_matrix(const SweepPlan& plan, const std::vector<PlannedFlight>& flights,
                         const Methods& methods);

/// Scores all runs, which are there.
MeasuredMap measure(const SweepPlan& plan, const SweepMatrix& sweep, const Methods& methods);

}  // namespace relock::maps
