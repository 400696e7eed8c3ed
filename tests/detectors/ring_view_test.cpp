#include "detectors/ring/view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/random.h"

namespace relock::ring {
namespace {

using Eigen::Vector2d;

View some_view(Random& random) {
  const double turn = 3 * random.uniform(), radius = 20 + 60 * random.uniform(),
               flat = 0.4 + 0.6 * random.uniform();
  const Vector2d a(std::cos(turn), std::sin(turn)), b(-a.y(), a.x());
  View view = with_diameters({300 * random.uniform(), 200 * random.uniform()}, radius * a, flat * radius * b);
  view.vanishing = 0.3 * (random.uniform() - 0.5) / radius * a + 0.3 * (random.uniform() - 0.5) / radius * b;
  view.blur = {40 * random.uniform(), 40 * random.uniform()};
  return view;
}

/// The point of the picture that is seen at q of the marker's plane.
Vector2d seen_at(const View& view, const Vector2d& q) {
  // q (1 + v.d) = S d
  const Eigen::Matrix2d m = view.shape() - q * view.vanishing.transpose();
  const double determinant = m(0, 0) * m(1, 1) - m(0, 1) * m(1, 0);
  return view.centre +
         Vector2d(m(1, 1) * q.x() - m(0, 1) * q.y(), m(0, 0) * q.y() - m(1, 0) * q.x()) / determinant;
}

TEST(RingView, OutlineIsTheImageOfTheUnitCircle) {
  Random random(1);
  for (int n = 0; n < 50; ++n) {
    const View view = some_view(random);
    const Ellipse e = outline_of(view);
    for (double angle = 0; angle < 6; angle += 0.5) {
      const Vector2d p = seen_at(view, {std::cos(angle), std::sin(angle)});
      const double dx = p.x() - e.centre.x, dy = p.y() - e.centre.y, c = std::cos(e.angle_rad),
                   s = std::sin(e.angle_rad);
      EXPECT_NEAR(std::hypot((c * dx + s * dy) / e.semi_major, (c * dy - s * dx) / e.semi_minor), 1, 1e-9);
    }
    EXPECT_GE(e.semi_major, e.semi_minor);
    EXPECT_TRUE(well_formed(e));
  }
}

TEST(RingView, PlacedTurnsBackWhatIsSeen) {
  Random random(2);
  for (int n = 0; n < 50; ++n) {
    const View view = some_view(random);
    const Vector2d q(random.uniform() - 0.5, random.uniform() - 0.5);
    const Vector2d p = seen_at(view, q);
    EXPECT_LT((placed(view, p).q - q).norm(), 1e-12);
    for (int axis = 0; axis < 2; ++axis) {
      const Vector2d step = 1e-4 * Vector2d::Unit(axis);
      const Vector2d change = (placed(view, p + step).q - placed(view, p - step).q) / 2e-4;
      EXPECT_LT((change - placed(view, p).moved_by.col(axis)).norm(), 1e-7);
    }
  }
}

TEST(RingView, LargerPixelsSeeTheSameMarker) {
  Random random(3);
  const View view = some_view(random), larger = in_larger_pixels(view, 4);
  // The pixel (10, 7) of the larger ones is the mean of 40..43 x 28..31, whose middle is (41.5, 29.5).
  EXPECT_LT((placed(larger, {10, 7}).q - placed(view, {41.5, 29.5}).q).norm(), 1e-12);
  const View back = in_smaller_pixels(larger, 4);
  EXPECT_LT((back.centre - view.centre).norm() + (back.blur - view.blur).norm() +
                (back.vanishing - view.vanishing).norm() + (back.shape() - view.shape()).norm(),
            1e-12);
}

TEST(RingView, ConjugateDiametersEndOnTheOutline) {
  const Vector2d a(30, 10), b(-5, 22);
  const View view = with_diameters({50, 60}, a, b);
  for (double angle = 0; angle < 6; angle += 0.5)
    EXPECT_NEAR(placed(view, Vector2d(50, 60) + std::cos(angle) * a + std::sin(angle) * b).q.norm(), 1,
                1e-12);
}

TEST(RingView, WhoseVanishingLineCrossesTheMarkerIsImpossible) {
  View view = straight_on({0, 0}, 50);
  EXPECT_TRUE(view.possible());
  view.vanishing = {0.9 / 50, 0};
  EXPECT_TRUE(view.possible());
  view.vanishing = {1.1 / 50, 0};
  EXPECT_FALSE(view.possible());
  view = straight_on({0, 0}, 50), view.yy = -view.yy;
  EXPECT_FALSE(view.possible());
}

TEST(RingView, BlurHasADirectionWithoutASign) {
  View view = straight_on({0, 0}, 50);
  view.blur = {-3, -4};
  EXPECT_DOUBLE_EQ(blur_of(view).length_px, 5);
  EXPECT_NEAR(blur_of(view).direction_rad, std::atan2(4, 3), 1e-12);
  view.blur = {-3, 0};
  EXPECT_NEAR(blur_of(view).direction_rad, 0, 1e-12);
}

}  // namespace
}  // namespace relock::ring
