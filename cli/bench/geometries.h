#pragma once

#include <string>
#include <vector>

#include "cli/bench/bench.h"
#include "cli/json_text.h"

// `relock bench ring --geometries`: which rings read best under blur.

namespace relock::bench {

struct TriedGeometry {
  std::string name;      ///< what is special about it
  std::string geometry;  ///< as ring_geometry() takes it
  double quiet_zone = 1.3;
};
/// Two bits: equal widths with holes of one to five widths, filled discs, the paper's, and quiet zones.
const std::vector<TriedGeometry>& tried_geometries();

/// Each before a plain grey and in clutter, D 150 px, by length of the blur: recognition and centre. `method`'s options
/// but for geometry and quiet zone are kept.
struct GeometryRates {
  TriedGeometry tried;
  std::vector<Measured> plain, clutter;  ///< recognised, by blur
  Measured centre;                       ///< of what was recognised in clutter at the shortest of them
};
std::vector<GeometryRates> measure_geometries(const Settings& settings, const Methods& methods);

std::string text_of(const std::vector<GeometryRates>& all);
Json json_of(const std::vector<GeometryRates>& all);

}  // namespace relock::bench
