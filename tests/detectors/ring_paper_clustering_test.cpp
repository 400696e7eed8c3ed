#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry.h"
#include "core/random.h"
#include "detectors/ring_paper/clustering.h"

namespace relock::ring_paper {
namespace {

Things on_a_line(const std::vector<double>& at) {
  return {.count = at.size(),
          .distance = [at](std::size_t a, std::size_t b) { return std::abs(at[a] - at[b]); }};
}

std::vector<double> heights(const std::vector<Merge>& merges) {
  std::vector<double> all;
  for (const Merge& merge : merges) all.push_back(merge.distance);
  return all;
}

TEST(AverageLinkage, GivesTheDendrogramWorkedByHandOfFourPoints) {
  // 0 and 2 become one at 2. 5 is 5 and 3 from them: 4. Then 12 is 12, 10 and 7 from the three: 29/3.
  const std::vector<Merge> merges = average_linkage(on_a_line({0, 2, 5, 12}));
  ASSERT_EQ(merges.size(), 3u);
  EXPECT_EQ(std::pair(merges[0].a, merges[0].b), std::pair(std::size_t{0}, std::size_t{1}));
  EXPECT_EQ(std::pair(merges[1].a, merges[1].b), std::pair(std::size_t{0}, std::size_t{2}));
  EXPECT_EQ(std::pair(merges[2].a, merges[2].b), std::pair(std::size_t{0}, std::size_t{3}));
  EXPECT_DOUBLE_EQ(merges[0].distance, 2);
  EXPECT_DOUBLE_EQ(merges[1].distance, 4);
  EXPECT_NEAR(merges[2].distance, 29.0 / 3, 1e-6);
}

TEST(AverageLinkage, CountsEveryMemberTheSameWhicheverWayItsClusterGrew) {
  // WPGMA would have the pair {0, 1} weigh as much as 4 in their cluster: (19.5 + 16) / 2. UPGMA takes the mean of
  // 20, 19 and 16.
  EXPECT_NEAR(average_linkage(on_a_line({0, 1, 4, 20})).back().distance, 55.0 / 3, 1e-6);
}

TEST(AverageLinkage, CountsAThingAsOftenAsItsWeight) {
  Things things = on_a_line({0, 2, 10});
  things.weights = {3, 1, 1};
  EXPECT_NEAR(average_linkage(things).back().distance, (3 * 10 + 8) / 4.0, 1e-6);
}

/// Looks for the nearest pair among all, every time, with distances averaged over members each time.
std::vector<double> naive_heights(const Things& things) {
  std::vector<Cluster> clusters;
  for (std::size_t i = 0; i < things.count; ++i) clusters.push_back({i});
  std::vector<double> all;
  while (clusters.size() > 1) {
    double least = std::numeric_limits<double>::infinity();
    std::size_t first = 0, second = 0;
    for (std::size_t a = 0; a < clusters.size(); ++a)
      for (std::size_t b = a + 1; b < clusters.size(); ++b) {
        double sum = 0;
        for (const std::size_t i : clusters[a])
          for (const std::size_t j : clusters[b]) sum += things.distance(i, j);
        sum /= static_cast<double>(clusters[a].size() * clusters[b].size());
        if (sum < least) least = sum, first = a, second = b;
      }
    all.push_back(least);
    clusters[first].insert(clusters[first].end(), clusters[second].begin(), clusters[second].end());
    clusters.erase(clusters.begin() + static_cast<std::ptrdiff_t>(second));
  }
  return all;
}

TEST(AverageLinkage, AgreesWithTheSearchForTheNearestPairOnRandomPoints) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    std::vector<Vec2> points(3 + seed);
    for (Vec2& p : points) p.x = 100 * random.uniform(), p.y = 100 * random.uniform();
    const Things things{.count = points.size(), .distance = [&](std::size_t a, std::size_t b) {
                          return norm(points[a] - points[b]);
                        }};
    const std::vector<double> expected = naive_heights(things), got = heights(average_linkage(things));
    ASSERT_EQ(got.size(), expected.size());
    for (std::size_t i = 0; i < got.size(); ++i) EXPECT_NEAR(got[i], expected[i], 1e-4) << seed;
  }
}

TEST(ClustersWithin, AreThoseOfAllMergesUpToTheDistance) {
  const Things things = on_a_line({0, 100, 2, 104, 5, 300});
  EXPECT_EQ(clusters_within(things, 1), (std::vector<Cluster>{{0}, {1}, {2}, {3}, {4}, {5}}));
  EXPECT_EQ(clusters_within(things, 3), (std::vector<Cluster>{{0, 2}, {1}, {3}, {4}, {5}}));
  EXPECT_EQ(clusters_within(things, 10), (std::vector<Cluster>{{0, 2, 4}, {1, 3}, {5}}));
  EXPECT_EQ(clusters_within(things, 150), (std::vector<Cluster>{{0, 1, 2, 3, 4}, {5}}));
  EXPECT_EQ(clusters_within(things, 1000), (std::vector<Cluster>{{0, 1, 2, 3, 4, 5}}));
}

TEST(ClustersWithin, AreNoneOfNothingAndOneOfOneThing) {
  EXPECT_TRUE(clusters_within(on_a_line({}), 150).empty());
  EXPECT_EQ(clusters_within(on_a_line({7}), 150), (std::vector<Cluster>{{0}}));
}

TEST(ClustersWithin, EndWithEqualDistancesToo) {
  EXPECT_EQ(clusters_within(on_a_line(std::vector<double>(40, 3.0)), 0).size(), 1u);
  std::vector<double> even;
  for (int i = 0; i < 64; ++i) even.push_back(i);
  EXPECT_EQ(clusters_within(on_a_line(even), 1000).size(), 1u);
}

}  // namespace
}  // namespace relock::ring_paper
