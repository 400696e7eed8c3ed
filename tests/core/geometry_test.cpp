#include "core/geometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/opencv.h"
#include "core/random.h"

namespace relock {
namespace {

TEST(Box, OfAnIntegerRectangleReachesHalfAPixelBeyondItsPixelCentres) {
  const Box box = box_of({10, 10, 20, 20});
  EXPECT_EQ(box, (Box{9.5, 9.5, 20, 20}));
  EXPECT_EQ(centre_of(box), (Vec2{19.5, 19.5}));
  EXPECT_EQ(rounded_rect(box), cv::Rect(10, 10, 20, 20));
}

TEST(Size, OfAnyOutlineScalesWithIt) {
  EXPECT_DOUBLE_EQ(size_of(Box{0, 0, 4, 9}), 6);
  EXPECT_DOUBLE_EQ(size_of(Quad{{Vec2{0, 0}, {10, 0}, {10, 10}, {0, 10}}}), 10);
  EXPECT_DOUBLE_EQ(size_of(Ellipse{{0, 0}, 8, 3, 1}), 16);
}

TEST(BetweenAxes, IsTheSameWhateverTheirSensesAndOrder) {
  constexpr double kPi = std::numbers::pi;
  for (const double from : {-7.0, -0.1, 0.0, 1.0, 3.1, 9.0})
    for (const double apart : {0.0, 0.3, 1.5, kPi / 2})
      for (const double sense : {-2 * kPi, 0.0, kPi, 3 * kPi}) {
        EXPECT_NEAR(between_axes(from, from + apart + sense), apart, 1e-12);
        EXPECT_NEAR(between_axes(from - apart + sense, from), apart, 1e-12);
      }
}

TEST(DiagonalsMeet, WhereASquaresCentreIsSeenUnderPerspective) {
  // A unit square about the origin, seen by x' = x / (1 + x / 4), y' = y / (1 + x / 4): the centre stays at
  // 0, 0.
  Quad quad;
  const Vec2 corners[] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  for (std::size_t i = 0; i < 4; ++i) quad.corner[i] = (1 / (1 + corners[i].x / 4)) * corners[i];
  EXPECT_NEAR(norm(diagonals_meet(quad)), 0, 1e-12);
  EXPECT_GT(norm(centre_of(quad)), 0.05) << "the outline's centre is elsewhere";
}

TEST(Bounds, OfATurnedEllipseTouchItsPoints) {
  const Ellipse ellipse{{5, 7}, 10, 4, 0.6};
  const Box box = bounds(ellipse);
  double right = -1e9;
  for (int i = 0; i < 100000; ++i) {
    const double t = 2 * std::numbers::pi * i / 100000;
    right = std::max(right, 5 + std::cos(0.6) * 10 * std::cos(t) - std::sin(0.6) * 4 * std::sin(t));
  }
  EXPECT_NEAR(box.right(), right, 1e-6);
}

TEST(ShareInside, OfHalfAnEllipseIsAHalf) {
  EXPECT_NEAR(share_inside(Ellipse{{0, 0}, 10, 4, 0.3}, {0, -100, 100, 200}), 0.5, 1e-3);
}

TEST(ShareInside, AddsUpOverTwoHalvesOfThePlane) {
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    Quad quad{{Vec2{0, 0}, {10, 0}, {10, 10}, {0, 10}}};
    for (Vec2& corner : quad.corner) corner = corner + Vec2{4 * random.uniform(), 4 * random.uniform()};
    const double cut = 12 * random.uniform();
    const double left = share_inside(quad, {-100, -100, 100 + cut, 300});
    const double right = share_inside(quad, {cut, -100, 300, 300});
    EXPECT_NEAR(left + right, 1, 1e-9);
  }
}

TEST(Overlap, IsSymmetricAndOneOnlyForTheSameBox) {
  const Box a{0, 0, 10, 10}, b{5, 0, 10, 10};
  EXPECT_DOUBLE_EQ(intersection_over_union(a, b), 1.0 / 3);
  EXPECT_DOUBLE_EQ(intersection_over_union(b, a), 1.0 / 3);
  EXPECT_DOUBLE_EQ(intersection_over_union(a, a), 1);
  EXPECT_DOUBLE_EQ(intersection_over_union(a, {20, 20, 1, 1}), 0);
}

TEST(WellFormed, RefusesWhatIsNotFiniteOrHasNoSize) {
  EXPECT_TRUE(well_formed(Box{0, 0, 1, 1}));
  EXPECT_FALSE(well_formed(Box{0, 0, 0, 1}));
  EXPECT_FALSE(well_formed(Box{std::nan(""), 0, 1, 1}));
  EXPECT_FALSE(well_formed(Ellipse{{0, 0}, 1, 2, 0}));
  EXPECT_FALSE(well_formed(Quad{}));
}

}  // namespace
}  // namespace relock
