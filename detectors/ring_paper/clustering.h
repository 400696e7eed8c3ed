#pragma once

#include <cstddef>
#include <vector>

#include "core/geometry.h"

namespace relock::ring_paper {

/// Members of one cluster: ranks of points, rising.
using Cluster = std::vector<std::size_t>;

/// Two clusters that became one.
struct Merge {
  std::size_t a = 0, b = 0;  ///< a point of each, a < b
  double distance = 0;       ///< mean distance over all pairs of points, one of each
};

/// The dendrogram of hierarchical clustering with unweighted average linkage (UPGMA): two clusters are as far apart
/// as their points are on average, and the two nearest become one, again and again. From the nearest merge to the
/// farthest; one less than there are points.
///
/// By chains of nearest neighbours (Murtagh 1983), which gives the same tree as looking for the nearest pair every
/// time, in time and memory that grow with the square of the number of points: 1000 points take 4 MB.
std::vector<Merge> average_linkage(const std::vector<Vec2>& points);

/// The clusters of all merges up to `distance`, in the order of their first members.
std::vector<Cluster> clusters_within(const std::vector<Vec2>& points, double distance);

}  // namespace relock::ring_paper
