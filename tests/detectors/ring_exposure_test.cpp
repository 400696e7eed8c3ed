#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "detectors/ring/exposure.h"

namespace relock::ring {
namespace {

double between(Random& random, double low, double high) { return low + (high - low) * random.uniform(); }

/// A view at random: tilted, seen in perspective, with a blur of so many radii at most.
View some_view(Random& random, double most_blur) {
  const double radius = between(random, 20, 60), turn = between(random, 0, 3.14159),
               flat = between(random, 0.6, 1);
  const Eigen::Vector2d a(std::cos(turn), std::sin(turn)), b(-a.y(), a.x());
  View view = with_diameters({100 + between(random, -1, 1), 90 + between(random, -1, 1)}, radius * a,
                             flat * radius * b);
  const double blur = between(random, 0, most_blur) * radius, direction = between(random, 0, 3.14159);
  view.blur = blur * Eigen::Vector2d(std::cos(direction), std::sin(direction));
  view.vanishing = between(random, -0.1, 0.1) / radius * b;
  return view;
}

/// The definition, with many moments of the exposure.
double brute_force_light(const RingMarker& marker, const View& view, double psf_px, double x, double y) {
  const RadialProfile profile(rings_of(marker));
  const Placed at = placed(view, {x, y});
  const Eigen::Vector2d u = at.moved_by * view.blur;
  constexpr int kMoments = 4000;
  double sum = 0;
  for (int k = 0; k < kMoments; ++k) {
    const Eigen::Vector2d q = at.q + ((k + 0.5) / kMoments - 0.5) * u;
    const double sigma = psf_px * (at.moved_by.transpose() * q.normalized()).norm();
    sum += profile.value(q.norm(), sigma) / kMoments;
  }
  return sum;
}

double* unknown(View& view, Light& light, int which) {
  double* all[kUnknowns] = {&view.centre.x(),    &view.centre.y(),   &view.xx,    &view.xy,      &view.yy,
                            &view.blur.x(),      &view.blur.y(),     &light.gain, &light.offset, &light.leak,
                            &view.vanishing.x(), &view.vanishing.y()};
  return all[which];
}

TEST(RingExposure, IsTheMeanOverAllMomentsWhateverTheViewAndTheBlur) {
  Random random(1);
  RingModel model(even_ring_geometry(2));
  double worst = 0;
  for (int n = 0; n < 60; ++n) {
    const View view = some_view(random, n % 2 ? 0.3 : 2.5);
    const std::size_t code = static_cast<std::size_t>(n) % 4;
    const RingMarker marker{model.geometry(), all_ring_bits(2)[code]};
    const Exposure exposure(model, code, view, 0.7);
    for (int k = 0; k < 20; ++k) {
      const double x = view.centre.x() + between(random, -1, 1) * view.radius();
      const double y = view.centre.y() + between(random, -1, 1) * view.radius();
      const auto fx = static_cast<float>(x), fy = static_cast<float>(y);
      float is = 0;
      exposure.rings(&fx, &fy, 1, &is);
      worst = std::max(worst, std::abs(is - brute_force_light(marker, view, 0.7, x, y)));
    }
  }
  EXPECT_LT(worst, 0.02);
  RecordProperty("worst", std::to_string(worst));
  std::printf("worst %g\n", worst);
}

TEST(RingExposure, ChangesWithEveryUnknownAsItsGradientSays) {
  Random random(2);
  RingModel model(even_ring_geometry(2));
  double worst[kUnknowns] = {}, scale[kUnknowns] = {};
  for (int n = 0; n < 200; ++n) {
    const View view = some_view(random, n % 2 ? 0.3 : 2.5);
    const Light light{20, 150, 80};
    const auto x = static_cast<float>(view.centre.x() + between(random, -1.1, 1.1) * view.radius());
    const auto y = static_cast<float>(view.centre.y() + between(random, -1.1, 1.1) * view.radius());
    Prediction here, after, before;
    Exposure(model, 2, view, 1.0).predict(&x, &y, 1, light, here);
    for (int k = 0; k < kUnknowns; ++k) {
      View up = view, down = view;
      Light lup = light, ldown = light;
      const double step = k == kGain || k == kOffset || k == kLeak ? 1
                          : (k == kXX || k == kXY || k == kYY)     ? 0.02 / view.radius()
                          : k >= kVanishingX                       ? 0.02 / view.radius()
                                                                   : 0.02 * view.radius();
      *unknown(up, lup, k) += step, *unknown(down, ldown, k) -= step;
      Exposure(model, 2, up, 1.0).predict(&x, &y, 1, lup, after),
          Exposure(model, 2, down, 1.0).predict(&x, &y, 1, ldown, before);
      const double change = (after.grey[0] - before.grey[0]) / 2;
      worst[k] += std::pow(change - step * here.gradient[k][0], 2), scale[k] += change * change;
    }
  }
  for (int k = 0; k < kUnknowns; ++k)
    std::printf("%d: %g of %g\n", k, std::sqrt(worst[k] / 200), std::sqrt(scale[k] / 200));
}

}  // namespace
}  // namespace relock::ring
