// The ring marker's definition, as ring.md and the authors' prints have it.
#include "detectors/ring_marker.h"

#include <gtest/gtest.h>

#include <set>

#include "core/error.h"
#include "detectors/printed_square.h"

namespace relock {
namespace {

constexpr int kSteps = 4000;  // of rho from 0 to 2

/// The whole pattern along a radius.
std::vector<double> profile(const RingMarker& marker) {
  std::vector<double> light;
  for (int i = 0; i < kSteps; ++i) light.push_back(reflectance(marker, 2 * (i + 0.5) / kSteps));
  return light;
}

std::string refusal(std::string_view geometry, int bits) {
  try {
    ring_geometry(geometry, bits);
  } catch (const Error& fault) {
    return fault.what();
  }
  return "taken";
}

TEST(RingMarker, HasTheRingsOfTheAuthorsPrints) {
  const RingMarker marker{paper_ring_geometry(), "01"};
  for (const double white : {.19, .32, .42, .54, .86, .99}) EXPECT_EQ(reflectance(marker, white), 1) << white;
  for (const double black : {0., .17, .34, .40, .56, .70, .84, 1.01, 1.29})
    EXPECT_EQ(reflectance(marker, black), 0) << black;
}

TEST(RingMarker, HasTheLastBitNearestToTheMiddle) {
  EXPECT_EQ(reflectance({paper_ring_geometry(), "10"}, .70), 1);
  EXPECT_EQ(reflectance({paper_ring_geometry(), "10"}, .48), 0);
  const RingMarker marker{even_ring_geometry(3), "100"};
  EXPECT_EQ(rings_of(marker), (std::vector<Annulus>{{.1, .2}, {.7, .8}, {.9, 1}}));
}

TEST(RingMarker, HasItsInnermostAndItsOutermostRingWhateverTheCode) {
  for (int bits = 1; bits <= kMostRingBits; ++bits)
    for (const std::string& code : all_ring_bits(bits)) {
      const RingMarker marker{even_ring_geometry(bits), code};
      EXPECT_EQ(rings_of(marker).front(), marker.geometry.slots.front());
      EXPECT_EQ(rings_of(marker).back(), marker.geometry.slots.back());
      EXPECT_EQ(rings_of(marker).size(),
                2u + static_cast<std::size_t>(std::count(code.begin(), code.end(), '1')));
    }
}

TEST(RingMarker, LooksDifferentForEveryCode) {
  for (int bits = 1; bits <= kMostRingBits; ++bits) {
    std::set<std::vector<double>> seen;
    const auto codes = all_ring_bits(bits);
    EXPECT_EQ(codes.size(), std::size_t{1} << bits);
    for (const std::string& code : codes) seen.insert(profile({ring_geometry("paper", bits), code}));
    EXPECT_EQ(seen.size(), codes.size()) << bits;
  }
}

TEST(RingMarker, OfEvenGeometryHasRingsAndGapsAndHoleOfOneWidth) {
  for (int bits = 1; bits <= kMostRingBits; ++bits) {
    double last = 0;
    for (const Annulus& slot : even_ring_geometry(bits).slots) {
      EXPECT_NEAR(slot.inner - last, 1.0 / (2 * bits + 4), 1e-12);
      EXPECT_NEAR(slot.width(), 1.0 / (2 * bits + 4), 1e-12);
      last = slot.outer;
    }
    EXPECT_EQ(last, 1);
  }
}

TEST(RingMarker, InvertedIsOneMinusItselfUpToTheQuietZonesEdge) {
  RingMarker marker{paper_ring_geometry(), "10"};
  const auto upright = profile(marker);
  marker.geometry.inverted = true;
  const auto inverted = profile(marker);
  for (std::size_t i = 0; i < upright.size(); ++i) {
    const bool inside = 2 * (static_cast<double>(i) + 0.5) / kSteps <= marker.geometry.quiet_zone;
    EXPECT_EQ(inverted[i], inside ? 1 - upright[i] : 1) << i;
  }
}

TEST(RingMarker, FadesFromBlackToWhitePaperWithoutAStep) {
  RingMarker marker{paper_ring_geometry(), "11"};
  marker.geometry.soft_border = 0.3;
  double last = 0;
  for (double rho = 1.3; rho <= 1.6 + 1e-9; rho += 0.001) {
    const double light = reflectance(marker, rho);
    EXPECT_GE(light, last);
    EXPECT_LT(light - last, 0.01);
    last = light;
  }
  EXPECT_EQ(reflectance(marker, 1.6), 1);
  EXPECT_EQ(reflectance(marker, 100), 1);
  marker.geometry.soft_border = 0;
  EXPECT_EQ(reflectance(marker, 1.3), 0);
  EXPECT_EQ(reflectance(marker, 1.3001), 1);
}

TEST(RingMarker, IsCalledByTheNumberOfItsBits) {
  EXPECT_EQ(code_of({paper_ring_geometry(), "01"}), (Code{"ring2", "01"}));
  EXPECT_EQ(code_of({even_ring_geometry(6), "010110"}), (Code{"ring6", "010110"}));
}

TEST(RingGeometry, IsTheOneThatItsTextSays) {
  for (const std::string text : {"paper", "even", "0-0.2,0.4-0.6,0.8-1", "0.2-0.3,0.31-0.35,0.5-0.7,0.9-1"}) {
    const int bits = text.starts_with("0-") ? 1 : 2;
    const RingGeometry geometry = ring_geometry(text, bits);
    EXPECT_EQ(slots_text(geometry), text);
    EXPECT_EQ(ring_geometry(slots_text(geometry), bits), geometry);
  }
  EXPECT_EQ(ring_geometry("paper", 3), even_ring_geometry(3));
  EXPECT_EQ(ring_geometry("0.1-0.3/0.5-0.6/0.8-1", 1), ring_geometry("0.1-0.3,0.5-0.6,0.8-1", 1));
}

TEST(RingGeometry, IsRefusedWithWhatIsWrongWithIt) {
  EXPECT_NE(refusal("papr", 2).find("write paper, even, or the radii"), std::string::npos);
  EXPECT_NE(refusal("", 2).find("is none"), std::string::npos);
  EXPECT_NE(refusal("0.1-0.2,,0.8-1", 1).find("is none"), std::string::npos);
  EXPECT_NE(refusal("0.1-0.2,0.4-x,0.8-1", 1).find("(\"x\")"), std::string::npos);
  EXPECT_NE(refusal("0.1-nan,0.4-0.5,0.8-1", 1).find("(\"nan\")"), std::string::npos);
  EXPECT_NE(refusal("0.1-0.2,0.8-1", 2).find("has 2 rings; 2 bits need 4"), std::string::npos);
  EXPECT_NE(refusal("0.1-0.2,0.2-0.5,0.8-1", 1).find("must rise"), std::string::npos);
  EXPECT_NE(refusal("0.1-0.2,0.6-0.5,0.8-1", 1).find("0.6-0.5"), std::string::npos);
  EXPECT_NE(refusal("-0.1-0.2,0.4-0.5,0.8-1", 1).find("is none"), std::string::npos);
  EXPECT_NE(refusal("0.1-0.2,0.4-0.5,0.8-1.1", 1).find("must end at radius 1, not at 1.1"),
            std::string::npos);
  EXPECT_NE(refusal("even", 7).find("1 to 6 bits, not 7"), std::string::npos);
  EXPECT_NE(refusal("even", 0).find("1 to 6 bits, not 0"), std::string::npos);
  for (const char* bits : {"", "2", "0 1", "0101010", "ab"})
    EXPECT_THROW(check_ring_bits(bits), Error) << bits;
}

TEST(RingGeometry, OfThePaperCountsAsEquallyWideAndOneOfThinRingsDoesNot) {
  EXPECT_TRUE(equally_wide(paper_ring_geometry()));
  for (int bits = 1; bits <= kMostRingBits; ++bits) EXPECT_TRUE(equally_wide(even_ring_geometry(bits)));
  EXPECT_FALSE(equally_wide(ring_geometry("0.1-0.3,0.5-0.6,0.8-1", 1)));
}

TEST(PrintedSquares, HaveWhiteAllAroundThemAndBlackAlongTheirOutline) {
  for (const std::string& family : square_marker_families()) {
    const MarkerCells cells = square_marker_cells({family, "7"});
    const auto at = [&](int x, int y) { return cells.grey[static_cast<std::size_t>(y * cells.side + x)]; };
    ASSERT_EQ(cells.grey.size(), static_cast<std::size_t>(cells.side * cells.side));
    for (int i = 0; i < cells.side; ++i)
      EXPECT_EQ(at(i, 0) + at(0, i) + at(i, cells.side - 1) + at(cells.side - 1, i), 4 * 255) << family;
    // Inside or, for the families with bits outside of it, just outside of the outline.
    const bool outside =
        family.find("Standard") != std::string::npos || family.find("Circle") != std::string::npos;
    const int border = outside ? cells.margin - 1 : cells.margin;
    for (int i = border; i < cells.side - border; ++i) EXPECT_EQ(at(i, border) + at(border, i), 0) << family;
  }
}

TEST(PrintedSquares, AreRefusedWhenThereAreNone) {
  for (const Code& code : {Code{"aruco6x6_25", "1"},
                           {"tag36h11", "1"},
                           {"aruco6x6_250", "250"},
                           {"aruco6x6_250", "-1"},
                           {"aruco6x6_250", "01x"},
                           {"aruco6x6_250", ""},
                           {"apriltag36h11", "587"},
                           {"apriltag36h11", "99999999999"}})
    EXPECT_THROW(square_marker_cells(code), Error) << to_string(code);
}

}  // namespace
}  // namespace relock
