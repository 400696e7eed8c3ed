#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace relock::ring_paper {

/// Members of one cluster: ranks of things, rising.
using Cluster = std::vector<std::size_t>;

/// Two clusters that became one.
struct Merge {
  std::size_t a = 0, b = 0;  ///< a member of each, a < b
  double distance = 0;       ///< mean distance over all pairs, one member of each
};

/// What is clustered: so many things, how far two of them are apart, and how much each counts in a mean.
struct Things {
  std::size_t count = 0;
  std::function<double(std::size_t a, std::size_t b)> distance;
  std::vector<double> weights = {};  ///< above 0; none: all count the same
};

/// The dendrogram of hierarchical clustering with unweighted average linkage (UPGMA): two clusters are as far apart
/// as their members are on average, and the two nearest become one, again and again. From the nearest merge to the
/// farthest; one less than there are things.
///
/// By chains of nearest neighbours (Murtagh 1983), which gives the same tree as looking for the nearest pair every
/// time, in time and memory that grow with the square of the number of things: 1000 take 4 MB.
std::vector<Merge> average_linkage(const Things& things);

/// The clusters of all merges up to `distance`, in the order of their first members.
std::vector<Cluster> clusters_within(const Things& things, double distance);

}  // namespace relock::ring_paper
