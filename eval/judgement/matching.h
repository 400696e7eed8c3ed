#pragma once

#include <cstdint>
#include <vector>

namespace relock {

/// A sighting that lies near enough to a target to be matched to it.
struct Candidate {
  int target = 0;
  int sighting = 0;
  bool hit = false;           ///< within the hit gate, no wrong code
  std::int64_t distance = 0;  ///< e / D (or 1 - overlap) in steps of 1e-9, so that ties are exact
};

/// One-to-one matching with the most Hits, then the most pairs, then the least total distance (metrics.md
/// section 3). Among equals the first target takes the first sighting it can, in the order in which the
/// candidates stand: sorted by target, and for each target in its order of preference among equals; taking
/// none comes last. Exact for any number of targets and sightings.
///
/// Returns, for each candidate, whether it is a pair of the matching.
std::vector<bool> match(const std::vector<Candidate>& candidates);

}  // namespace relock
