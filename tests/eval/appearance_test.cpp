#include "eval/inspection/appearance.h"

#include <opencv2/core/mat.hpp>

#include <gtest/gtest.h>

#include "core/opencv.h"
#include "core/random.h"

namespace relock {
namespace {

TEST(Appearance, OfARampHasItsSlopeAndNoNoise) {
  cv::Mat ramp(120, 160, CV_8UC1);
  for (int y = 0; y < ramp.rows; ++y)
    for (int x = 0; x < ramp.cols; ++x) ramp.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(x + 20);
  AppearanceGatherer gatherer;
  gatherer.add(view(ramp));
  const Appearance appearance = gatherer.result();
  EXPECT_NEAR(appearance.gradient_mean, 1, 0.2);
  EXPECT_NEAR(appearance.mean_gray, 20 + 79.5, 0.5);
  for (const auto& noise : appearance.noise) EXPECT_LT(noise.value_or(0), 0.1);
}

TEST(Appearance, FindsTheNoiseOfEachShade) {
  Random random(5);
  AppearanceGatherer gatherer;
  for (int frame = 0; frame < 4; ++frame) {
    cv::Mat picture(160, 320, CV_8UC1);
    for (int y = 0; y < picture.rows; ++y)
      for (int x = 0; x < picture.cols; ++x) {
        const bool bright = x >= 160;
        picture.at<std::uint8_t>(y, x) =
            cv::saturate_cast<std::uint8_t>((bright ? 176 : 80) + (bright ? 6 : 2) * random.normal());
      }
    gatherer.add(view(picture));
  }
  const Appearance appearance = gatherer.result();
  EXPECT_NEAR(appearance.noise[2].value(), 2, 0.2);
  EXPECT_NEAR(appearance.noise[5].value(), 6, 0.4);
  EXPECT_FALSE(appearance.noise[0]);
}

TEST(Appearance, OfNothingIsNothing) {
  const Appearance appearance = AppearanceGatherer().result();
  EXPECT_EQ(appearance.gradient_mean, 0);
  EXPECT_FALSE(appearance.noise[3]);
}

}  // namespace
}  // namespace relock
