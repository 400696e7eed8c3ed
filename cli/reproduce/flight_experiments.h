#pragma once

#include <vector>

#include "cli/reproduce/experiment.h"
#include "cli/reproduce/flight_scores.h"

namespace relock::reproduction {

/// Table 2: four flights before a ring between two square markers. QUICK: 120 frames of the second.
std::vector<Finding> table_2(const Settings& settings, const Methods& methods);
/// Figure 12: round a box, once with rings and once with square markers. Left out of QUICK.
std::vector<Finding> figure_12(const Settings& settings, const Methods& methods);

/// The findings, from what the methods made of the flights: for table 2 one flight for each of the first tests, or
/// QUICK the second alone, and the same with AprilTags, if that was flown.
Finding finding_of_tests(const Settings& settings, const std::vector<ScoredComparison>& tests,
                         const std::vector<ScoredComparison>& apriltags);
/// `rings`: null when no detector looked for them.
Finding finding_of_box(const ScoredComparison& squares, const ScoredComparison* rings);

}  // namespace relock::reproduction
