#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "detectors/ring/chord_templates.h"

namespace relock::ring {
namespace {

/// The light at rho on the line, by summing reflectance() over the movement and a Gaussian along the line.
double brute_force(const RingMarker& marker, double rho, const Exposed& exposed) {
  constexpr int kMoments = 60, kSofts = 25;
  double sum = 0, weights = 0;
  for (int soft = -kSofts; soft <= kSofts; ++soft) {
    const double off = 3.0 * soft / kSofts, weight = std::exp(-off * off / 2);
    const double on_line = rho + off * exposed.softness;
    for (int moment = 0; moment < kMoments; ++moment) {
      const double moved = ((moment + 0.5) / kMoments - 0.5) * exposed.blur;
      sum += weight / kMoments *
             reflectance(marker, std::hypot(on_line * std::sin(exposed.misalignment_rad) + moved,
                                            on_line * std::cos(exposed.misalignment_rad)));
    }
    weights += weight;
  }
  return sum / weights;
}

TEST(ChordTemplates, AgreeWithBruteForceAveragingOfTheMarker) {
  RingGeometry geometry = paper_ring_geometry();
  geometry.quiet_zone = 4;
  const ChordTemplates templates(geometry, 2);
  const auto codes = all_ring_bits(geometry.bits());
  for (std::size_t rank = 0; rank < templates.size(); rank += 5) {
    const ChordTemplates::Shape& shape = templates.shape(rank);
    std::array<double, kFoldSamples> values{};
    double mean = 0, squares = 0, likeness = 0;
    for (std::size_t i = 0; i < kFoldSamples; ++i) {
      const double rho = (static_cast<double>(i) + 0.5) / kFoldSamples * kReach * shape.edge;
      values[i] = brute_force({geometry, codes[shape.code]}, rho, shape.exposed);
      mean += values[i] / kFoldSamples;
    }
    for (std::size_t i = 0; i < kFoldSamples; ++i) {
      squares += (values[i] - mean) * (values[i] - mean);
      likeness += (values[i] - mean) * templates.fold(rank)[i];
    }
    EXPECT_GT(likeness / std::sqrt(squares), 0.999)
        << codes[shape.code] << " blurred by " << shape.exposed.blur << " at "
        << shape.exposed.misalignment_rad;
  }
}

TEST(ChordTemplates, FindThemselves) {
  for (const int bits : {1, 2, 3, 4}) {
    const ChordTemplates templates(even_ring_geometry(bits), 2);
    for (std::size_t rank = 0; rank < templates.size(); ++rank) {
      const auto match = templates.best(templates.fold(rank));
      EXPECT_NEAR(match.likeness, 1, 1e-5);
      EXPECT_EQ(templates.shape(match.shape).code, templates.shape(rank).code);
    }
  }
}

TEST(ChordTemplates, MatchAsOneProductAfterTheOtherDoes) {
  const ChordTemplates templates(paper_ring_geometry(), 2);
  Random random(4);
  for (int trial = 0; trial < 200; ++trial) {
    Fold fold{};
    for (float& value : fold) value = static_cast<float>(random.normal());
    double best = -1e9;
    for (std::size_t rank = 0; rank < templates.size(); ++rank) {
      double product = 0;
      for (std::size_t i = 0; i < kFoldSamples; ++i) product += double{fold[i]} * templates.fold(rank)[i];
      best = std::max(best, product);
    }
    EXPECT_NEAR(templates.best(fold).likeness, best, 1e-5);
  }
}

TEST(ChordTemplates, BlurMovesTheOuterEdgeInwardsOnly) {
  const ChordTemplates templates(paper_ring_geometry(), 2);
  for (std::size_t rank = 0; rank < templates.size(); ++rank) {
    EXPECT_GT(templates.shape(rank).edge, 0.855 - 1e-9);
    EXPECT_LT(templates.shape(rank).edge, 1.1);
    if (templates.shape(rank).exposed.blur == 0) {
      EXPECT_NEAR(templates.shape(rank).edge, 1, 0.006);
    }
  }
}

}  // namespace
}  // namespace relock::ring
