#include <gtest/gtest.h>

#include <array>
#include <map>
#include <opencv2/core.hpp>

#include "core/display_coding.h"
#include "core/opencv.h"
#include "detectors/ring.h"
#include "tests/detectors/drawn_ring.h"
#include "tests/detectors/drawn_rings.h"
#include "tests/fault.h"

namespace relock {
namespace {

constexpr std::array kColours{SheetColour::black, SheetColour::red, SheetColour::green, SheetColour::blue};

/// A marker on a coloured sheet before grey, under light of which this much is red, green and blue; blurred in light.
cv::Mat3b picture_of(SheetColour sheet, const std::string& bits, const Reflected& light, std::uint64_t seed) {
  const Reflected dark = reflected_by(sheet);
  const std::array<double, 3> sheet_bgr{dark.blue, dark.green, dark.red},
      light_bgr{light.blue, light.green, light.red};
  cv::Mat channels[3];
  for (std::size_t c = 0; c < 3; ++c) {
    cv::Mat1b linear(260, 260, static_cast<std::uint8_t>(80 * light_bgr[c]));
    const RingMarker marker{paper_ring_geometry(), bits};
    draw(linear, marker,
         {.centre = {131.3, 128.8},
          .radius_px = 55,
          .blur = {30, 12},
          .black = light_bgr[c] * (8 + 170 * sheet_bgr[c]),
          .white = light_bgr[c] * 180});
    cv::Mat1b coded(linear.size());
    for (int y = 0; y < linear.rows; ++y)
      for (int x = 0; x < linear.cols; ++x)
        coded(y, x) = cv::saturate_cast<std::uint8_t>(255 * coded_of_light(linear(y, x) / 255.0));
    add_noise(coded, 4, seed + c);
    channels[c] = coded;
  }
  cv::Mat3b picture;
  cv::merge(channels, 3, picture);
  return picture;
}

TEST(RingColours, AreToldUnderBlurAndLightThatIsNotWhite) {
  const auto detector = ring_detector({.colours = true});
  std::uint64_t seed = 1;
  for (const SheetColour sheet : kColours)
    for (const Reflected& light : {Reflected{1, 1, 1}, Reflected{1, 0.8, 0.6}, Reflected{0.7, 0.85, 1}}) {
      const std::string bits = seed % 2 == 0 ? "00" : "10";
      const cv::Mat3b picture = picture_of(sheet, bits, light, seed += 3);
      const Sightings seen = detector->detect(view(picture), {});
      ASSERT_EQ(seen.size(), 1U) << to_string(sheet) << bits;
      EXPECT_EQ(seen[0].code, code_of({paper_ring_geometry(), bits, sheet})) << to_string(sheet);
    }
}

TEST(RingColours, AreLeftAloneUnlessAskedFor) {
  const Sightings seen =
      ring_detector({})->detect(view(picture_of(SheetColour::red, "01", {1, 1, 1}, 1)), {});
  ASSERT_EQ(seen.size(), 1U);
  EXPECT_EQ(seen[0].code, (Code{"ring2", "01"}));
}

TEST(RingOptions, AreAllTakenFromTheCommandLine) {
  const std::map<std::string, std::string> others{
      {"bits", "3"},           {"geometry", "even"}, {"quiet_zone", "1.6"},
      {"inverted", "true"},    {"colours", "true"},  {"min_diameter_px", "30"},
      {"max_candidates", "3"}, {"tone", "light"},    {"refine", "ceres"}};
  const Options plain("ring", ring_option_list(), {});
  EXPECT_EQ(ring_options(plain), RingOptions{});
  for (const OptionInfo& option : ring_option_list()) {
    ASSERT_TRUE(others.contains(option.name)) << option.name;
    const Options given("ring", ring_option_list(), {{option.name, others.at(option.name)}});
    EXPECT_NE(ring_options(given), RingOptions{}) << option.name;
  }
}

TEST(RingColours, NeedAPictureInColour) {
  const cv::Mat1b grey(200, 200, std::uint8_t{100});
  EXPECT_NE(
      fault_of([&] { ring_detector({.colours = true})->detect(view(grey), {}); }).find("pictures in colour"),
      std::string::npos);
}

TEST(RingColours, AreDarkEnoughForReadersOfGrey) {
  // docs/ring.md: a sheet half as bright as the rings costs next to nothing.
  for (const SheetColour sheet : kColours)
    EXPECT_LT(coded_of_light(reflected_by(sheet).grey()), 0.5) << to_string(sheet);
}

TEST(RingColours, OfAValueAreReadAsTheyAreWritten) {
  for (const SheetColour sheet : kColours) {
    const RingValue value{"011", sheet};
    EXPECT_EQ(parse_ring_value(to_string(value)).bits, "011");
    EXPECT_EQ(parse_ring_value(to_string(value)).sheet, sheet);
    EXPECT_EQ(nearest_sheet_colour(reflected_by(sheet)), sheet);
  }
  EXPECT_NE(fault_of([] { parse_ring_value("01-yellow"); }).find("red, green and blue"), std::string::npos);
  EXPECT_NE(fault_of([] { parse_ring_value("01-black"); }).find("red, green and blue"), std::string::npos);
}

}  // namespace
}  // namespace relock
