#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "core/blur.h"
#include "core/opencv.h"
#include "core/random.h"
#include "trackers/patch_blur.h"
#include "trackers/patch_searcher.h"

namespace relock {
namespace {

/// Blobs of random grey, some pixels wide.
cv::Mat textured(std::uint64_t seed, int width, int height) {
  Random random(seed);
  cv::Mat small(height / 8, width / 8, CV_8UC1), picture;
  for (int y = 0; y < small.rows; ++y)
    for (int x = 0; x < small.cols; ++x)
      small.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(random.below(256));
  cv::resize(small, picture, {width, height}, 0, 0, cv::INTER_CUBIC);
  return picture;
}

TEST(PatchSearcher, FindsTheTargetWithinTheRegionAndNothingOutsideOfThePicture) {
  const cv::Mat first = textured(1, 320, 240);
  cv::Mat later = textured(2, 320, 240);
  first(cv::Rect(100, 100, 40, 32)).copyTo(later(cv::Rect(170, 130, 40, 32)));
  const auto searcher = patch_searcher();
  EXPECT_FALSE(searcher->find(view(later), picture_box({320, 240})));
  searcher->remember(view(first), {99.5, 99.5, 40, 32});
  const auto found = searcher->find(view(later), {140, 100, 110, 100});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->box.x, 169.5, 0.5);
  EXPECT_NEAR(found->box.y, 129.5, 0.5);
  EXPECT_GT(found->likeness, 0.99);
  EXPECT_FALSE(searcher->find(view(later), {-500, 0, 100, 100}));
  EXPECT_FALSE(searcher->find(Image(), {140, 100, 110, 100}));
}

TEST(PatchBlur, TellsALinearBlurToItsStepsAndNothingOfASharpPicture) {
  for (const double degrees : {0.0, 40.0, 95.0, 150.0})
    for (const double length : {16.0, 28.0, 40.0}) {
      const cv::Mat sharp = textured(3, 320, 240);
      const Box box{109.5, 89.5, 64, 64};
      const BlurMeter meter = patch_blur();
      EXPECT_FALSE(meter(view(sharp), box)) << "the first look is the measure";
      EXPECT_FALSE(meter(view(sharp), box)) << "sharp";
      cv::Mat blurred;
      cv::filter2D(sharp, blurred, -1, blur_kernel({degrees * std::numbers::pi / 180, length}));
      const auto told = meter(view(blurred), box);
      ASSERT_TRUE(told) << degrees << " degrees, " << length << " px";
      const double off = std::remainder(told->direction_rad * 180 / std::numbers::pi - degrees, 180);
      EXPECT_LE(std::abs(off), 16) << degrees << " degrees, " << length << " px";
      EXPECT_NEAR(told->length_px, length, 9) << degrees << " degrees";
    }
}

}  // namespace
}  // namespace relock
