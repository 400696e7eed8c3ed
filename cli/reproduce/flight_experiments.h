#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/reproduce/experiment.h"
#include "cli/reproduce/flight_scores.h"

namespace relock::reproduction {

/// The ring's detector as it comes, whose rates are the predictions; and with one constant of the paper's changed after
/// they were known, to see whether the other markers near the ring are what it fails at.
inline constexpr std::string_view kRing = "ring-paper", kRingApart = "ring-paper(linkage_px=60)";
/// What the second one says of the first. `rings`: what both made of the same flights.
std::string what_neighbours_cost(const std::vector<FlightScores>& rings);

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
