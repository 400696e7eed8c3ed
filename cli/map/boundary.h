#pragma once

#include <optional>
#include <span>
#include <vector>

#include "cli/map/cells.h"

namespace relock::maps {

/// Where along a row (or a column) of the map the lead changes hands.
///
/// `at` is where the monotone fit of the differences (isotonic least squares, rising or falling, whichever
/// fits better) passes through zero. Its interval is found by turning the question round (Fieller's method,
/// point by point): it reaches from `at` on either side to the nearest cell at which the winner of that side
/// is ahead beyond doubt, and from there back as far as that holds, where between two cells the differences
/// are interpolated seed by seed. So it covers all the undecided cells about the boundary. It is open where
/// no such cell comes before the map's edge.
struct Boundary {
  double at = 0;                    ///< in the unit of the axis
  std::optional<double> low, high;  ///< empty: open, beyond the map
  Ahead before = Ahead::tracking;   ///< who leads at lesser values of the axis
};

/// `axis`: strictly increasing; places whose difference is n/a are passed over. Nothing when the fit has one sign
/// all along or is zero up to an end, and when neither side has a winner beyond doubt: then it is noise that
/// passes through zero.
std::optional<Boundary> boundary_of(std::span<const double> axis, std::span<const Estimate> differences);

/// Least squares among sequences that never fall (pool adjacent violators).
std::vector<double> isotonic(std::span<const double> values);

}  // namespace relock::maps
