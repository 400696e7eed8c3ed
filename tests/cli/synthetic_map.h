#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "cli/map/sweep.h"
#include "core/random.h"

namespace relock::maps {

/// A tracker and a detector whose locked share in every cell is known: `shares(row, column)`, to which every
/// seed adds normal noise of this deviation. Flights last 10 s.
using KnownShare = std::function<double(std::size_t row, double column)>;

inline MethodMap known_method(const std::string& name, MethodClass kind, const SweepPlan& plan,
                              const KnownShare& share, double noise, std::uint64_t draw) {
  MethodMap method{name, kind, Grid<LockedTime>(plan.exposures_ms.size())};
  Random random(draw);
  for (std::size_t row = 0; row < plan.exposures_ms.size(); ++row) {
    for (const double column : plan.columns) {
      LockedTime cell;
      for (int seed = 0; seed < plan.seeds; ++seed) {
        cell.visible_s.push_back(10);
        cell.locked_s.push_back(10 * (share(row, column) + noise * random.normal()));
      }
      method.cells[row].push_back(cell);
    }
  }
  return method;
}

/// Two rows of blur; in the first detection wins from gaps of 5 slots on, in the second tracking wins throughout.
inline MeasuredMap known_map(double noise, std::uint64_t draw, int seeds = 5) {
  MeasuredMap map;
  map.plan.columns = {1, 2, 4, 6, 8, 12};
  map.plan.exposures_ms = {5, 25};
  map.plan.seeds = seeds;
  map.blur = {{2, 5}, {10, 25}};
  const auto tracking = [](std::size_t, double gap) { return 0.95 - 0.05 * gap; };
  const auto detection = [](std::size_t row, double) { return row == 0 ? 0.7 : 0.1; };
  map.methods = {known_method("follow", MethodClass::tracker, map.plan, tracking, noise, 2 * draw),
                 known_method("find", MethodClass::detector, map.plan, detection, noise, 2 * draw + 1)};
  map.ceilings.assign(2, Grid<std::optional<double>>(2, std::vector<std::optional<double>>(6, 1.0)));
  return map;
}

/// In its first cell no flight sees the target.
inline MeasuredMap with_a_blind_cell(MeasuredMap map) {
  for (MethodMap& method : map.methods) {
    LockedTime& cell = method.cells[0][0];
    cell.locked_s.assign(cell.locked_s.size(), 0);
    cell.visible_s.assign(cell.visible_s.size(), 0);
  }
  for (auto& ceilings : map.ceilings) ceilings[0][0].reset();
  return map;
}

}  // namespace relock::maps
