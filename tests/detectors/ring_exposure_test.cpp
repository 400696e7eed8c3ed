#include "detectors/ring/exposure.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"

namespace relock::ring {
namespace {

double between(Random& random, double low, double high) { return low + (high - low) * random.uniform(); }

/// A view at random: tilted, seen in perspective, with a blur of `most_blur` radii at most.
View some_view(Random& random, double most_blur) {
  const double radius = between(random, 20, 60), turn = between(random, 0, 3.14),
               flat = between(random, 0.6, 1);
  const Eigen::Vector2d a(std::cos(turn), std::sin(turn)), b(-a.y(), a.x());
  View view = with_diameters({100 + between(random, -1, 1), 90 + between(random, -1, 1)}, radius * a,
                             flat * radius * b);
  const double blur = between(random, 0, most_blur) * radius, direction = between(random, 0, 3.14);
  view.blur = blur * Eigen::Vector2d(std::cos(direction), std::sin(direction));
  view.vanishing = between(random, -0.1, 0.1) / radius * b;
  return view;
}

struct Point {
  float x, y;
};
Point some_point(Random& random, const View& view) {
  return {static_cast<float>(view.centre.x() + between(random, -1.2, 1.2) * view.radius()),
          static_cast<float>(view.centre.y() + between(random, -1.2, 1.2) * view.radius())};
}

/// The definition, with many moments: the picture moves evenly, whatever that means in the marker's plane.
double mean_over_moments(const std::vector<Annulus>& annuli, const View& view, double psf_px, Point p) {
  const RadialProfile profile(annuli);
  const Placed middle = placed(view, {p.x, p.y});
  const double sigma = psf_px * (middle.moved_by.transpose() * middle.q.normalized()).norm();
  constexpr int kMoments = 200;
  double sum = 0;
  for (int k = 0; k < kMoments; ++k) {
    const double t = (k + 0.5) / kMoments - 0.5;
    sum += profile.value(placed(view, Eigen::Vector2d(p.x, p.y) + t * view.blur).q.norm(), sigma) / kMoments;
  }
  return sum;
}

TEST(RingExposure, IsTheMeanOverAllMomentsWhateverTheViewAndTheBlur) {
  Random random(1);
  RingModel model(even_ring_geometry(2));
  double squares = 0, worst = 0;
  constexpr int kViews = 24, kPoints = 6;
  for (int n = 0; n < kViews; ++n) {
    const View view = some_view(random, n % 2 ? 0.3 : 2.5);
    const auto code = static_cast<std::size_t>(n) % 4;
    const auto annuli = rings_of({model.geometry(), all_ring_bits(2)[code]});
    for (int k = 0; k < kPoints; ++k) {
      const Point p = some_point(random, view);
      float is = 0;
      Exposure(model, code, view, 0.7).rings(&p.x, &p.y, 1, &is);
      const double off = std::abs(is - mean_over_moments(annuli, view, 0.7, p));
      squares += off * off / (kViews * kPoints), worst = std::max(worst, off);
    }
  }
  // What is left is a lens whose sigma differs by up to a tenth from one that there is a table for.
  EXPECT_LT(worst, 0.05);
  EXPECT_LT(std::sqrt(squares), 0.01);
}

TEST(RingExposure, SeesBeyondTheSheetWhenTheBlurIsLong) {
  Random random(4);
  RingModel model(even_ring_geometry(2));
  const double radius = model.geometry().quiet_zone + model.geometry().soft_border / 2;
  for (int n = 0; n < 60; ++n) {
    const View view = some_view(random, 3);
    const Point p = some_point(random, view);
    float part = 0;
    Exposure(model, 0, view, 0.7).leaked(&p.x, &p.y, 1, &part);
    EXPECT_NEAR(part, 1 - mean_over_moments({{0, radius}}, view, 0.7, p), 0.035);
  }
}

double& unknown(View& view, Light& light, int which) {
  double* all[kUnknowns] = {&view.centre.x(),    &view.centre.y(),   &view.xx,    &view.xy,      &view.yy,
                            &view.blur.x(),      &view.blur.y(),     &light.gain, &light.offset, &light.leak,
                            &view.vanishing.x(), &view.vanishing.y()};
  return *all[which];
}

/// A change of an unknown that moves the picture by some hundredths of the radius.
double step_of(int which, const View& view) {
  if (which == kGain || which == kOffset || which == kLeak) return 1;
  const bool inverse = (which >= kXX && which <= kYY) || which >= kVanishingX;
  return inverse ? 0.01 / view.radius() : 0.01 * view.radius();
}

TEST(RingExposure, ChangesWithEveryUnknownAsItsGradientSays) {
  Random random(2);
  RingModel model(even_ring_geometry(2));
  double both[kUnknowns] = {}, said[kUnknowns] = {};
  for (int n = 0; n < 600; ++n) {
    const View view = some_view(random, n % 2 ? 0.3 : 2.5);
    const Light light{20, 150, 80};
    const Point p = some_point(random, view);
    Prediction here, up, down;
    Exposure(model, 2, view, 1.5).predict(&p.x, &p.y, 1, light, here);
    for (int k = 0; k < kUnknowns; ++k) {
      View more = view, less = view;
      Light brighter = light, darker = light;
      unknown(more, brighter, k) += step_of(k, view), unknown(less, darker, k) -= step_of(k, view);
      Exposure(model, 2, more, 1.5).predict(&p.x, &p.y, 1, brighter, up);
      Exposure(model, 2, less, 1.5).predict(&p.x, &p.y, 1, darker, down);
      const double change = (up.grey[0] - down.grey[0]) / 2;
      const double gradient = step_of(k, view) * here.gradient[k][0];
      both[k] += change * gradient, said[k] += gradient * gradient;
    }
  }
  // By regression: between two entries of a table a curve is drawn as a line, and a step may change the entry.
  for (int k = 0; k < kUnknowns; ++k) EXPECT_NEAR(both[k] / said[k], 1, 0.05) << "unknown " << k;
}

TEST(RingExposure, IsTheSameWhenTheMarkerMovesTheOtherWay) {
  Random random(3);
  RingModel model(even_ring_geometry(2));
  for (int n = 0; n < 40; ++n) {
    View view = some_view(random, 2.5);
    const Point p = some_point(random, view);
    float one = 0, other = 0;
    Exposure(model, 1, view, 0.7).rings(&p.x, &p.y, 1, &one);
    view.blur = -view.blur;
    Exposure(model, 1, view, 0.7).rings(&p.x, &p.y, 1, &other);
    EXPECT_NEAR(one, other, 1e-5);
  }
}

TEST(RingExposure, OfABlockIsThatOfItsPixels) {
  Random random(5);
  RingModel model(paper_ring_geometry());
  for (const double blur : {0.2, 2.0}) {
    const View view = some_view(random, blur);
    const Exposure exposure(model, 3, view, 0.7);
    Row x, y;
    for (int i = 0; i < kBlock; ++i) {
      const Point p = some_point(random, view);
      x[i] = p.x, y[i] = p.y;
    }
    Prediction all, one;
    exposure.predict(x, y, kBlock, {10, 200, 50}, all);
    for (int i = 0; i < kBlock; ++i) {
      exposure.predict(x + i, y + i, 1, {10, 200, 50}, one);
      EXPECT_NEAR(one.grey[0], all.grey[i], 0.1);
      for (int k = 0; k < kUnknowns; ++k)
        EXPECT_NEAR(step_of(k, view) * one.gradient[k][0], step_of(k, view) * all.gradient[k][i], 0.1);
    }
  }
}

}  // namespace
}  // namespace relock::ring
