#include "detectors/ring/fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "tests/detectors/drawn_rings.h"

namespace relock::ring {
namespace {

using Eigen::Vector2d;

constexpr double kPsf_px = 0.6, kNoise = 2;
const Light kLight{30, 170, 90};

/// What the model says that a picture shows, with noise.
cv::Mat1b predicted(RingModel& model, std::size_t code, const View& view, double noise = kNoise) {
  cv::Mat1b picture(200, 240);
  const Exposure exposure(model, code, view, kPsf_px);
  Row x, y;
  Prediction is;
  for (int row = 0; row < picture.rows; ++row)
    for (int from = 0; from < picture.cols; from += kBlock) {
      const int n = std::min(kBlock, picture.cols - from);
      for (int i = 0; i < n; ++i) x[i] = static_cast<float>(from + i), y[i] = static_cast<float>(row);
      exposure.predict(x, y, n, kLight, is);
      for (int i = 0; i < n; ++i) picture(row, from + i) = cv::saturate_cast<std::uint8_t>(is.grey[i]);
    }
  if (noise > 0) add_noise(picture, noise, 1);
  return picture;
}

View tilted(double blur_px) {
  View view = with_diameters({118.3, 97.6}, Vector2d(40, 12), Vector2d(-9, 30));
  view.vanishing = {0.0015, -0.001};
  view.blur = blur_px * Vector2d(0.8, 0.6);
  return view;
}

/// About a third of a ring off in everything.
View beside(const View& view) {
  View off = view;
  off.centre += Vector2d(1.5, -1);
  off.xx *= 1.04, off.yy *= 0.97, off.blur *= 0.9, off.vanishing = {0, 0};
  if (off.blur.norm() < 1) off.blur = {1, 0.5};
  return off;
}

const FitOptions kFine{.pixels = 900, .steps = 15, .psf_px = kPsf_px, .settled = 0.001};

TEST(RingFit, ComesHomeFromAThirdOfARingAwayWhateverTheBlur) {
  RingModel model(even_ring_geometry(2));
  Fitter fitter(model);
  for (const double blur : {0.0, 12.0, 35.0}) {
    const View truth = tilted(blur);
    const auto fit = fitter.fit(predicted(model, 2, truth), 2, beside(truth), kFine);
    ASSERT_TRUE(fit) << blur;
    EXPECT_LT((fit->view.centre - truth.centre).norm(), 0.2) << blur;
    EXPECT_NEAR(fit->view.radius(), truth.radius(), 0.01 * truth.radius()) << blur;
    EXPECT_LT((fit->view.shape() - truth.shape()).norm() * truth.radius(), 0.02) << blur;
    if (blur > 0) {
      EXPECT_NEAR(blur_of(fit->view).length_px, blur, 0.6) << blur;
      EXPECT_NEAR(blur_of(fit->view).direction_rad, std::atan2(0.6, 0.8), 0.03) << blur;
    }
    EXPECT_NEAR(fit->light.gain, kLight.gain, 0.03 * kLight.gain) << blur;
    EXPECT_NEAR(fit->light.offset, kLight.offset, 4) << blur;
  }
}

TEST(RingFit, FindsThePerspective) {
  RingModel model(even_ring_geometry(2));
  Fitter fitter(model);
  const View truth = tilted(0);
  const auto fit = fitter.fit(predicted(model, 1, truth), 1, beside(truth), kFine);
  ASSERT_TRUE(fit);
  EXPECT_LT((fit->view.vanishing - truth.vanishing).norm(), 0.2 * truth.vanishing.norm());
}

TEST(RingFit, LeavesTheNoiseUnexplainedAndNothingElse) {
  RingModel model(even_ring_geometry(2));
  Fitter fitter(model);
  for (const double noise : {2.0, 6.0}) {
    const View truth = tilted(12);
    const auto fit = fitter.fit(predicted(model, 3, truth, noise), 3, beside(truth), kFine);
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->residual, noise, 0.2 * noise);
    // Half of a marker is white: its pixels vary by some half of the gain, less with the blur.
    EXPECT_GT(fit->misfit, noise / kLight.gain);
    EXPECT_LT(fit->misfit, 6 * noise / kLight.gain);
  }
}

TEST(RingFit, LeavesMoreUnexplainedWithTheCodeOfAnotherMarker) {
  RingModel model(even_ring_geometry(2));
  Fitter fitter(model);
  const View truth = tilted(12);
  const cv::Mat1b picture = predicted(model, 1, truth);
  const auto right = fitter.fit(picture, 1, beside(truth), kFine);
  ASSERT_TRUE(right);
  for (const std::size_t other : {0U, 2U, 3U}) {
    const auto wrong = fitter.fit(picture, other, beside(truth), kFine);
    if (wrong) {
      EXPECT_GT(wrong->misfit, 3 * right->misfit) << other;
    }
  }
}

TEST(RingFit, IsNoneWhereTooLittleOfTheMarkerIsInThePicture) {
  RingModel model(even_ring_geometry(2));
  Fitter fitter(model);
  const cv::Mat1b picture = predicted(model, 0, tilted(0));
  for (const Vec2 outside : {Vec2{-40, 90}, Vec2{280, 90}, Vec2{118, -38}, Vec2{-1e5, 1e5}})
    EXPECT_FALSE(fitter.fit(picture, 0, straight_on(outside, 36), kFine));
}

TEST(RingFit, IsNoneInABlankPicture) {
  RingModel model(even_ring_geometry(2));
  Fitter fitter(model);
  EXPECT_FALSE(fitter.fit(cv::Mat1b(200, 240, std::uint8_t{90}), 0, tilted(8), kFine));
}

TEST(RingFit, TellsTheLightOfEachRing) {
  for (const int bits : {1, 2, 3}) {
    RingModel model(even_ring_geometry(bits));
    Fitter fitter(model);
    for (std::size_t code = 0; code < model.codes(); ++code)
      for (const double blur : {0.0, 25.0}) {
        const View truth = tilted(blur);
        const auto lights = fitter.ring_lights(predicted(model, code, truth), {truth, kLight}, kFine);
        ASSERT_TRUE(lights);
        ASSERT_EQ(lights->ring.size(), model.slots());
        EXPECT_NEAR(lights->ring.front().light, 1, 0.05);
        EXPECT_NEAR(lights->ring.back().light, 1, 0.05);
        for (std::size_t bit = 0; bit + 2 < model.slots(); ++bit)
          EXPECT_NEAR(lights->ring[bit + 1].light, (code >> bit) & 1 ? 1 : 0, 0.05)
              << bits << " " << code << " " << blur;
      }
  }
}

TEST(RingFit, LooksAtAboutAsManyPixelsAsItIsToldWithinTheMarkerAndThePicture) {
  RingModel model(even_ring_geometry(2));
  const cv::Mat1b picture(200, 240, std::uint8_t{0});
  Samples samples;
  for (const int count : {100, 400}) {
    spread_samples(picture, model, tilted(0), count, samples);
    EXPECT_NEAR(static_cast<double>(samples.size()), count, 0.15 * count);
    for (std::size_t i = 0; i < samples.size(); ++i)
      EXPECT_LE(placed(tilted(0), {samples.x[i], samples.y[i]}).q.norm(), 1.13);
  }
  // A marker far larger than the picture: quick, and nothing outside of it.
  spread_samples(picture, model, straight_on({100, 100}, 1e8), 130, samples);
  EXPECT_LT(samples.size(), 10U);
  View corner = straight_on({2, 3}, 60);
  spread_samples(picture, model, corner, 400, samples);
  EXPECT_GT(samples.size(), 60U);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    EXPECT_TRUE(samples.x[i] >= 0 && samples.x[i] < 240 && samples.y[i] >= 0 && samples.y[i] < 200);
  }
}

TEST(RingFit, TellsStructureFromNoiseInWhatItLeaves) {
  RingModel model(even_ring_geometry(2));
  Fitter fitter(model);
  const View truth = tilted(0);
  const cv::Mat1b noisy = predicted(model, 2, truth, 9);
  cv::Mat1b shaded = predicted(model, 2, truth, 1);
  for (int y = 0; y < shaded.rows; ++y)
    for (int x = 0; x < shaded.cols; ++x)
      shaded(y, x) =
          cv::saturate_cast<std::uint8_t>(shaded(y, x) + 20 * std::sin(0.3 * x) * std::sin(0.25 * y));
  const auto noise = fitter.fit(noisy, 2, beside(truth), kFine);
  const auto structure = fitter.fit(shaded, 2, beside(truth), kFine);
  ASSERT_TRUE(noise && structure);
  EXPECT_LT(noise->structure, 0.4 * noise->misfit);
  EXPECT_GT(structure->structure, 0.6 * structure->misfit);
}

}  // namespace
}  // namespace relock::ring
