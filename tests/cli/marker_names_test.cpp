// How markers and their sizes are asked for.
#include <gtest/gtest.h>

#include "cli/print/design.h"
#include "cli/print/length.h"
#include "core/error.h"

namespace relock {
namespace {

RingGeometry geometry_of(const std::string& name, const RingLook& look = {}) {
  return std::get<RingMarker>(design_of(name, look).form).geometry;
}

TEST(MarkerNames, AreSplitAtCommasOutsideOfParentheses) {
  EXPECT_EQ(names_in("ring(geometry=even,inverted=true):01,aruco6x6_250:0"),
            (std::vector<std::string>{"ring(geometry=even,inverted=true):01", "aruco6x6_250:0"}));
  EXPECT_EQ(names_in("ring:01"), std::vector<std::string>{"ring:01"});
  EXPECT_EQ(names_in("a,,b"), (std::vector<std::string>{"a", "", "b"}));
}

TEST(MarkerNames, SayTheLookOfTheirRings) {
  EXPECT_EQ(geometry_of("ring:01"), paper_ring_geometry());
  EXPECT_EQ(geometry_of("ring2:01"), paper_ring_geometry());
  EXPECT_EQ(geometry_of("ring(geometry=even):01"), even_ring_geometry(2));
  EXPECT_EQ(geometry_of("ring:011"), even_ring_geometry(3));
  const RingGeometry own = geometry_of(
      "ring3(geometry=0.1-0.2/0.3-0.4/0.5-0.6/0.7-0.8/0.9-1,quiet_zone=1.5,soft_border=0,inverted=true):000");
  EXPECT_EQ(own.slots, even_ring_geometry(3).slots);
  EXPECT_EQ(own.quiet_zone, 1.5);
  EXPECT_EQ(own.soft_border, 0);
  EXPECT_TRUE(own.inverted);
  const RingLook look{.geometry = "even", .inverted = true};
  EXPECT_TRUE(geometry_of("ring:01", look).inverted);
  EXPECT_FALSE(geometry_of("ring(inverted=false):01", look).inverted);
}

TEST(MarkerNames, ThatAreNoneAreRefused) {
  for (const char* name : {"",
                           "ring",
                           "ring:",
                           "ring:2",
                           "ring3:01",
                           "ring:0101010",
                           "rnig:01",
                           "ring(:01",
                           "ring):01",
                           "ring)(:01",
                           "ring(geometry=even)01",
                           "ring(geometry):01",
                           "ring(geometry=evn):01",
                           "ring(geometrie=even):01",
                           "ring(quiet_zone=0.9):01",
                           "ring(inverted=true,inverted=true):01",
                           "ring(geometry=0.1-0.2):01",
                           "aruco6x6_250",
                           "aruco6x6_250:",
                           "aruco6x6_250:250",
                           "aruco6x6_250(x=1):3",
                           "aruco:3",
                           "apriltag36h11:-1",
                           "disc:1",
                           "disc(geometry=even)",
                           ":",
                           "ring:01:01"})
    EXPECT_THROW(design_of(name), Error) << name;
}

TEST(Captions, SayCodeSizeAndGeometry) {
  EXPECT_EQ(
      caption_of(design_of("ring2:01"), 0.15),
      (std::vector<std::string>{"ring:01   diameter 150 mm   paper geometry",
                                "rings (bits) r/R 0.18-0.33 (0.41-0.55) (0.63-0.77) 0.855-1; black to 1.3, "
                                "white from 1.34"}));
  EXPECT_EQ(caption_of(design_of("aruco6x6_250:23"), 0.1).at(0), "aruco6x6_250:23   side 100 mm");
}

TEST(Lengths, AreReadInTheirUnits) {
  EXPECT_DOUBLE_EQ(parse_length_m("150mm", "--size"), 0.15);
  EXPECT_DOUBLE_EQ(parse_length_m("15cm", "--size"), 0.15);
  EXPECT_DOUBLE_EQ(parse_length_m("0.15 m", "--size"), 0.15);
  EXPECT_DOUBLE_EQ(parse_length_m("6in", "--size"), 0.1524);
  for (const char* text :
       {"", "150", "mm", "0mm", "-1mm", "nanmm", "infm", "150 furlongs", "11m", "1e400m", "15mm "})
    EXPECT_THROW(parse_length_m(text, "--size"), Error) << text;
}

}  // namespace
}  // namespace relock
