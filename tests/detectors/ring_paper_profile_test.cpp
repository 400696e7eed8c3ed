#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "detectors/ring_paper/components.h"
#include "detectors/ring_paper/profile.h"

namespace relock::ring_paper {
namespace {

/// Levels drawn as digits: 0 is dark, 9 is bright.
std::vector<float> levels(const std::string& drawn) {
  std::vector<float> all;
  for (const char digit : drawn) all.push_back(static_cast<float>(digit - '0'));
  return all;
}

TEST(BrightBars, BeginAndEndHalfwayUpTheirEdges) {
  for (const auto binarisation : {Binarisation::local, Binarisation::middle}) {
    const std::vector<Bar> bars = bright_bars(levels("000488884000488888400"), binarisation, 0.2);
    EXPECT_EQ(bars, (std::vector<Bar>{{3, 8}, {12, 18}}));
  }
}

TEST(BrightBars, AreOnlyThoseThatBeginAndEndWithinTheProfile) {
  for (const auto binarisation : {Binarisation::local, Binarisation::middle}) {
    EXPECT_EQ(bright_bars(levels("880000880000088"), binarisation, 0.2), (std::vector<Bar>{{5.5, 7.5}}));
    EXPECT_TRUE(bright_bars(levels("8800000000088"), binarisation, 0.2).empty());
    EXPECT_TRUE(bright_bars(levels("0000888"), binarisation, 0.2).empty());
  }
}

TEST(BrightBars, OfUnequalRingsAreAllSeenLocallyAndNotWithOneMiddleForAll) {
  const std::vector<float> unequal = levels("009900220066449900");
  EXPECT_EQ(bright_bars(unequal, Binarisation::local, 0.1).size(), 4u);
  EXPECT_EQ(bright_bars(unequal, Binarisation::middle, 0.1).size(), 3u);
}

TEST(BrightBars, DoNotCountARippleBelowTheProminence) {
  EXPECT_EQ(bright_bars(levels("0099899989900"), Binarisation::local, 0.2).size(), 1u);
  EXPECT_EQ(bright_bars(levels("0099899989900"), Binarisation::local, 0.1).size(), 3u);
}

TEST(BrightBars, AreNoneOnAProfileThatIsFlatOrEmpty) {
  for (const auto binarisation : {Binarisation::local, Binarisation::middle})
    for (const char* drawn : {"", "5", "555555555"})
      EXPECT_TRUE(bright_bars(levels(drawn), binarisation, 0.1).empty()) << drawn;
}

std::vector<Bar> bars(const std::vector<double>& widths) {
  std::vector<Bar> all;
  for (const double width : widths) {
    const double from = all.empty() ? 0 : all.back().to + 10;
    all.push_back({from, from + width});
  }
  return all;
}

TEST(AllowableMarks, HaveTwoBarsForEachRingFromTwoRingsToTwoMoreThanBits) {
  const auto counts = [](std::size_t bars_there, int bits) {
    std::vector<std::size_t> all;
    for (const Marks& marks : allowable_marks(bars(std::vector(bars_there, 10.0)), bits, 0.5))
      all.push_back(marks.bars.size());
    return all;
  };
  EXPECT_EQ(counts(3, 2), (std::vector<std::size_t>{}));
  EXPECT_EQ(counts(4, 2), (std::vector<std::size_t>{4}));
  EXPECT_EQ(counts(5, 2), (std::vector<std::size_t>{4, 4}));
  EXPECT_EQ(counts(8, 2), (std::vector<std::size_t>{8, 6, 6, 6, 4, 4, 4, 4, 4}));
  EXPECT_EQ(counts(6, 1), (std::vector<std::size_t>{6, 4, 4, 4}));
}

TEST(AllowableMarks, AreOfUniformWidth) {
  EXPECT_EQ(allowable_marks(bars({10, 11, 9, 10}), 2, 0.2).size(), 1u);
  EXPECT_EQ(allowable_marks(bars({10, 20, 9, 10}), 2, 0.2).size(), 0u);
  const auto within = allowable_marks(bars({40, 10, 11, 9, 10, 3}), 2, 0.2);  // with the edges of a sheet
  ASSERT_EQ(within.size(), 1u);
  EXPECT_EQ(within[0].from(), 50);
  EXPECT_EQ(within[0].to(), 120);
  EXPECT_EQ(within[0].rings(), 2);
  EXPECT_EQ(within[0].middle(), 85);
  EXPECT_EQ(within[0].radius(), 35);
}

TEST(Normalised, GoesFromOneOuterTransitionToTheOtherWithTheRangeFromZeroToOne) {
  const std::vector<float> drawn = levels("33333377337733773377333333");
  const Marks marks{{{6, 8}, {9.5, 12}, {13, 16}, {17, 20}}};
  const std::vector<float> sampled = normalised(drawn, marks, 15);
  EXPECT_EQ(sampled.size(), 15u);
  EXPECT_EQ(*std::min_element(sampled.begin(), sampled.end()), 0);
  EXPECT_EQ(*std::max_element(sampled.begin(), sampled.end()), 1);
  for (std::size_t i = 0; i < 15; ++i) EXPECT_EQ(sampled[i], (drawn[6 + i] - 3) / 4) << i;
}

TEST(IntensityProfile, IsTheMeanOfItsParallelLines) {
  const auto slope = [](Vec2 p) { return static_cast<float>(2 * p.x + p.y); };
  const Profile along = intensity_profile(slope, {{10, 20}, {14, 20}}, 3, 5);
  EXPECT_EQ(along.levels, (std::vector<float>{40, 42, 44, 46, 48}));
  EXPECT_EQ(along.at(2.5), (Vec2{12.5, 20}));
  const auto ridge = [](Vec2 p) { return p.y == 20 ? 90.0F : 0.0F; };
  EXPECT_EQ(intensity_profile(ridge, {{10, 20}, {11, 20}}, 1, 5).levels, (std::vector<float>{90, 90}));
  EXPECT_EQ(intensity_profile(ridge, {{10, 20}, {11, 20}}, 3, 5).levels, (std::vector<float>{30, 30}));
}

TEST(LevelAt, IsInterpolatedWithinAndThatOfTheBorderBeyond) {
  cv::Mat1b picture = (cv::Mat1b(2, 2) << 10, 20, 30, 40);
  EXPECT_EQ(level_at(picture, {0.5, 0.5}), 25);
  EXPECT_EQ(level_at(picture, {1, 0.25}), 25);
  EXPECT_EQ(level_at(picture, {-5, 0}), 10);
  EXPECT_EQ(level_at(picture, {99, 99}), 40);
}

/// One component that is a filled rectangle, turned.
Components bar_at(Vec2 centre, double length, double width, double angle) {
  cv::Mat1b picture(200, 200, std::uint8_t{0});
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 200; ++x) {
      const Vec2 d = Vec2{static_cast<double>(x), static_cast<double>(y)} - centre;
      const double u = d.x * std::cos(angle) + d.y * std::sin(angle),
                   v = -d.x * std::sin(angle) + d.y * std::cos(angle);
      if (std::abs(u) < length / 2 && std::abs(v) < width / 2) picture(y, x) = 255;
    }
  return connected_components(picture, 1, 100);
}

TEST(PrincipalAxis, OfABarIsItsOwn) {
  for (const double degrees : {-90.0, -60.0, -10.0, 0.0, 25.0, 45.0, 80.0}) {
    const double angle = degrees * std::numbers::pi / 180;
    const Axis axis = principal_axis(bar_at({101, 97}, 120, 20, angle).parts, {0});
    EXPECT_NEAR(std::abs(axis.direction.x * std::cos(angle) + axis.direction.y * std::sin(angle)), 1, 1e-4)
        << degrees;
    EXPECT_GE(axis.direction.x, 0);
    EXPECT_NEAR(norm(axis.mean - Vec2{101, 97}), 0, 0.2);
    EXPECT_NEAR(axis.reach, 120 / std::sqrt(12), 0.7);
    EXPECT_NEAR(axis.width, 20 / std::sqrt(12), 0.4);
  }
}

TEST(PrincipalAxis, OfTwoComponentsIsThatOfAllTheirPixels) {
  cv::Mat1b picture(100, 100, std::uint8_t{0});
  picture(cv::Rect(20, 50, 31, 3)) = std::uint8_t{255};
  picture(cv::Rect(20, 90, 31, 3)) = std::uint8_t{255};
  const Axis axis = principal_axis(connected_components(picture, 1, 100).parts, {0, 1});
  EXPECT_NEAR(std::abs(axis.direction.y), 1, 1e-12);  // across both, though each lies along x
  EXPECT_EQ(axis.mean, (Vec2{35, 71}));
  EXPECT_EQ(axis.box, (Box{19.5, 49.5, 31, 43}));
}

TEST(ThroughBox, EndsBeyondBothSidesOfTheBoxByTheMargin) {
  const Axis axis{.mean = {50, 40}, .direction = {1, 0}, .box = {10, 20, 60, 40}};
  EXPECT_EQ(through_box(axis, 5).from, (Vec2{5, 40}));
  EXPECT_EQ(through_box(axis, 5).to, (Vec2{75, 40}));
  const Axis slanted{.mean = {40, 40}, .direction = {0.6, 0.8}, .box = {10, 20, 60, 40}};
  EXPECT_NEAR(norm(through_box(slanted, 0).from - Vec2{25, 20}), 0, 1e-9);
  EXPECT_NEAR(norm(through_box(slanted, 0).to - Vec2{55, 60}), 0, 1e-9);
}

TEST(ConnectedComponents, KeepTheLargestOnesOfEnoughPixels) {
  cv::Mat1b picture(40, 40, std::uint8_t{0});
  picture(cv::Rect(1, 1, 2, 2)) = std::uint8_t{255};
  picture(cv::Rect(10, 1, 5, 4)) = std::uint8_t{255};
  picture(cv::Rect(1, 10, 3, 3)) = std::uint8_t{255};
  picture(cv::Rect(4, 13, 3, 3)) = std::uint8_t{255};  // touches by a corner
  const auto areas = [&](int least, int most) {
    std::vector<int> all;
    for (const Component& part : connected_components(picture, least, most).parts) all.push_back(part.area);
    return all;
  };
  EXPECT_EQ(areas(1, 100), (std::vector<int>{4, 20, 18}));
  EXPECT_EQ(areas(5, 100), (std::vector<int>{20, 18}));
  EXPECT_EQ(areas(1, 2), (std::vector<int>{20, 18}));
  EXPECT_EQ(areas(1, 1), (std::vector<int>{20}));
}

}  // namespace
}  // namespace relock::ring_paper
