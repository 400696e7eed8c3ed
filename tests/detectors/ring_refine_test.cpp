#include "detectors/ring/refine.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "core/opencv.h"
#include "detectors/ring.h"
#include "tests/detectors/drawn_ring.h"
#include "tests/detectors/drawn_rings.h"

namespace relock::ring {
namespace {

using Eigen::Vector2d;

constexpr double kPsf_px = 0.6;
const Light kLight{30, 170, 60};

View tilted(double blur_px) {
  View view = with_diameters({88.3, 77.6}, Vector2d(40, 12), Vector2d(-9, 30));
  view.vanishing = {0.0015, -0.001};
  view.blur = blur_px * Vector2d(0.8, 0.6);
  return view;
}

/// What the model says that a picture shows, with noise of 3 grey levels.
cv::Mat1b predicted(RingModel& model, const View& view, std::uint64_t seed) {
  cv::Mat1b picture(160, 180);
  const Exposure exposure(model, 2, view, kPsf_px);
  Row x, y;
  Prediction is;
  for (int row = 0; row < picture.rows; ++row)
    for (int from = 0; from < picture.cols; from += kBlock) {
      const int n = std::min(kBlock, picture.cols - from);
      for (int i = 0; i < n; ++i) x[i] = static_cast<float>(from + i), y[i] = static_cast<float>(row);
      exposure.predict(x, y, n, kLight, is);
      for (int i = 0; i < n; ++i) picture(row, from + i) = cv::saturate_cast<std::uint8_t>(is.grey[i]);
    }
  add_noise(picture, 3, seed);
  return picture;
}

/// What is left of a fit that a detector makes.
Fit fit_near(const View& truth) {
  Fit fit{truth, kLight};
  fit.view.centre += Vector2d(0.2, -0.15);
  fit.view.xx *= 1.003, fit.view.blur *= 0.98;
  fit.residual = 3;
  return fit;
}

TEST(RingRefinement, SaysHowFarItsCentreAndBlurMayBeOff) {
  RingModel model(even_ring_geometry(2));
  for (const double blur : {14.0, 35.0}) {
    const View truth = tilted(blur);
    double centre = 0, moved = 0;
    const int trials = 40;
    for (int trial = 0; trial < trials; ++trial) {
      const auto refined = refine(predicted(model, truth, static_cast<std::uint64_t>(trial)), model, 2,
                                  fit_near(truth), kPsf_px);
      ASSERT_TRUE(refined);
      const auto squared = [&](const Vector2d& off, int at) {
        return off.dot(refined->covariance.block<2, 2>(at, at).inverse() * off);
      };
      centre += squared(refined->fit.view.centre - truth.centre, kCentreX) / trials;
      moved += squared(refined->fit.view.blur - truth.blur, kBlurX) / trials;
    }
    // The mean of chi-squared with two degrees of freedom, over 40 trials, is 2 +- 0.32.
    EXPECT_NEAR(centre, 2, 1.1) << blur;
    EXPECT_NEAR(moved, 2, 1.1) << blur;
  }
}

TEST(RingRefinement, DoesNotDependOnWhereItBegins) {
  RingModel model(even_ring_geometry(2));
  const View truth = tilted(20);
  const cv::Mat1b picture = predicted(model, truth, 1);
  Fit other = fit_near(truth);
  other.view.centre -= Vector2d(0.5, 0.2);
  other.view.blur *= 1.05;
  const auto a = refine(picture, model, 2, fit_near(truth), kPsf_px),
             b = refine(picture, model, 2, other, kPsf_px);
  ASSERT_TRUE(a && b);
  EXPECT_LT((a->fit.view.centre - b->fit.view.centre).norm(), 0.003);
  EXPECT_LT((a->fit.view.blur - b->fit.view.blur).norm(), 0.02);
}

TEST(RingRefinement, IsAskedForByAnOption) {
  cv::Mat1b picture(300, 300, std::uint8_t{128});
  const RingMarker marker{paper_ring_geometry(), "01"};
  const DrawnRing truth{.centre = {151.3, 148.8}, .radius_px = 60, .blur = {24, 10}};
  draw(picture, marker, truth);
  add_noise(picture, 3, 5);
  RingOptions options;
  const Sightings plain = ring_detector(options)->detect(view(picture), {});
  options.refine = RingRefinement::ceres;
  const Sightings refined = ring_detector(options)->detect(view(picture), {});
  ASSERT_EQ(plain.size(), 1U);
  ASSERT_EQ(refined.size(), 1U);
  EXPECT_FALSE(plain[0].centre_covariance);
  ASSERT_TRUE(refined[0].centre_covariance && refined[0].blur_covariance);
  EXPECT_GT(refined[0].centre_covariance->xx, 0);
  EXPECT_LT(refined[0].centre_covariance->xx, 0.01);
  EXPECT_LT(norm(refined[0].centre - truth.centre), 0.03);
  EXPECT_NEAR(refined[0].blur->length_px, 26, 0.2);
}

}  // namespace
}  // namespace relock::ring
