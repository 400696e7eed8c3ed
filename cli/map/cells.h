#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "eval/statistics/interval.h"

// What a map is made of, and who wins where. Nothing here knows of simulating or running.

namespace relock::maps {

/// Time with a lock, and visible time, of one method in one cell: of every seed in turn, s. One seed is one
/// flight; the same seed flies the same way in every cell.
struct LockedTime {
  std::vector<double> locked_s, visible_s;
};

/// A number that seeds vote on, and by how much each departs from it. Nothing (n/a) where no seed has a vote.
///
/// The standard error is sqrt(sum of squared departures / (n (n - 1))), and the interval Student's with n - 1
/// degrees of freedom: seeds are independent and few, and a bootstrap of three flights is far too narrow.
struct Estimate {
  std::optional<double> value;
  /// Of every seed, nothing of one without a vote; they add up to 0.
  std::vector<std::optional<double>> departures;

  /// Without a second vote it is not known: from -infinity to infinity.
  Interval interval() const;
};

/// Locked share: locked time of all seeds over visible time of all seeds. A seed departs by what it adds to
/// the ratio (the linearised, or sandwich, estimator). A seed without visible time has no vote.
Estimate locked_share(const LockedTime& time);
/// a - b, paired by seed: those vote that have a vote in both. Nothing where either is nothing.
Estimate difference(const Estimate& a, const Estimate& b);
/// `part` of the way from a to b, seed by seed; likewise.
Estimate between(const Estimate& a, const Estimate& b, double part);

enum class MethodClass : std::uint8_t { tracker, detector, yardstick };
const char* to_string(MethodClass kind);

/// Rows of a map from the least blur up, and in each its columns.
template <class Cell>
using Grid = std::vector<std::vector<Cell>>;

/// One method over the whole map.
struct MethodMap {
  std::string name;  ///< as it would be typed
  MethodClass kind = MethodClass::tracker;
  Grid<LockedTime> cells;
};

/// Who keeps the target for longer. Ahead is who is ahead beyond doubt: the interval leaves out 0.
enum class Ahead : std::uint8_t { undecided, tracking, detection };

/// Of the difference of locked shares, tracking - detection.
Ahead ahead(const Estimate& difference);

/// The method of a class with the highest locked share over all cells, each counting the same; the first of
/// equals. Cells that are n/a do not count. Null without one.
const MethodMap* best_of(const std::vector<MethodMap>& methods, MethodClass kind);

/// tracking - detection, cell by cell.
Grid<Estimate> differences(const MethodMap& tracking, const MethodMap& detection);

}  // namespace relock::maps
