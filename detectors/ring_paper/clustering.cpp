#include "detectors/ring_paper/clustering.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace relock::ring_paper {
namespace {

/// Mean distances between the clusters that there are. A cluster is known by its first member.
class Distances {
 public:
  explicit Distances(const Things& things)
      : count_(things.count),
        weight_(things.weights.empty() ? std::vector(count_, 1.0) : things.weights),
        between_(count_ * (count_ - 1) / 2) {
    for (std::size_t b = 1; b < count_; ++b)
      for (std::size_t a = 0; a < b; ++a) at(a, b) = static_cast<float>(things.distance(a, b));
  }

  float between(std::size_t a, std::size_t b) { return a < b ? at(a, b) : at(b, a); }
  bool is_there(std::size_t a) const { return weight_[a] > 0; }

  /// The nearest other one; `preferred`, if it is as near, so that a chain ends.
  std::size_t nearest(std::size_t a, std::size_t preferred) {
    std::size_t best = preferred;
    float least = preferred < count_ ? between(a, preferred) : std::numeric_limits<float>::infinity();
    for (std::size_t b = 0; b < count_; ++b) {
      if (b == a || !is_there(b)) continue;
      if (const float d = between(a, b); d < least) least = d, best = b;
    }
    return best;
  }

  /// b goes into a. The mean over the pairs with a third cluster is the mean of both means, by their weights.
  void merge(std::size_t a, std::size_t b) {
    const double all = weight_[a] + weight_[b];
    const auto wa = static_cast<float>(weight_[a] / all), wb = static_cast<float>(weight_[b] / all);
    for (std::size_t c = 0; c < count_; ++c) {
      if (c == a || c == b || !is_there(c)) continue;
      const float mean = wa * between(a, c) + wb * between(b, c);
      (a < c ? at(a, c) : at(c, a)) = mean;
    }
    weight_[a] = all;
    weight_[b] = 0;  // it is gone
  }

 private:
  float& at(std::size_t a, std::size_t b) { return between_[b * (b - 1) / 2 + a]; }  // a < b

  std::size_t count_;
  std::vector<double> weight_;
  std::vector<float> between_;
};

std::size_t root_of(std::vector<std::size_t>& parent, std::size_t a) {
  while (parent[a] != a) a = parent[a] = parent[parent[a]];
  return a;
}

}  // namespace

std::vector<Merge> average_linkage(const Things& things) {
  std::vector<Merge> merges;
  if (things.count < 2) return merges;
  Distances distances(things);
  std::vector<std::size_t> chain;
  for (std::size_t first = 0; merges.size() + 1 < things.count;) {
    if (chain.empty()) {
      while (!distances.is_there(first)) ++first;
      chain.push_back(first);
    }
    const std::size_t last = chain.back();
    const std::size_t before = chain.size() > 1 ? chain[chain.size() - 2] : things.count;
    const std::size_t next = distances.nearest(last, before);
    if (next != before) {
      chain.push_back(next);
      continue;
    }
    // Each is the other's nearest: no other merge can come between them.
    const auto [a, b] = std::minmax(last, before);
    merges.push_back({a, b, distances.between(a, b)});
    distances.merge(a, b);
    chain.resize(chain.size() - 2);
  }
  std::stable_sort(merges.begin(), merges.end(),
                   [](const Merge& m, const Merge& n) { return m.distance < n.distance; });
  return merges;
}

std::vector<Cluster> clusters_within(const Things& things, double distance) {
  std::vector<std::size_t> parent(things.count);
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  for (const Merge& merge : average_linkage(things)) {
    if (merge.distance > distance) break;
    const auto [a, b] = std::minmax({root_of(parent, merge.a), root_of(parent, merge.b)});
    parent[b] = a;
  }
  std::vector<Cluster> clusters;
  std::vector<std::size_t> place(things.count);
  for (std::size_t i = 0; i < things.count; ++i) {
    const std::size_t root = root_of(parent, i);
    if (root == i) place[i] = clusters.size(), clusters.emplace_back();
    clusters[place[root]].push_back(i);
  }
  return clusters;
}

}  // namespace relock::ring_paper
