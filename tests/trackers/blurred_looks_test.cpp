#include "trackers/blut/blurred_looks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "core/blur.h"
#include "core/opencv.h"
#include "tests/trackers/blurred_world.h"

namespace relock::blut {
namespace {

using particles::Sampling, particles::State;

constexpr Vec2 kSize{BlurredWorld::kWidth, BlurredWorld::kHeight};
const State kState{.centre = BlurredWorld::kMiddle + Vec2{4.3, -2.6}};

TEST(BlurredLooks, AreThoseOfThePictureConvolvedWithTheKernel) {
  const cv::Mat1b sharp = BlurredWorld(1).picture(kState.centre);
  Sampling sampling({20, 20}, kSize);
  sampling.show(view(sharp), 1);
  const BlurFan fan{.directions = 5, .lengths = 4};
  const Eigen::MatrixXf looks = blurred_looks(sampling, kState, fan, kSize.x);
  for (int number = 0; number < fan.size(); ++number) {
    cv::Mat1f convolved;
    cv::filter2D(sharp, convolved, CV_32F, blur_kernel(fan.motion(number, kSize.x)));
    cv::Mat1b blurred;
    convolved.convertTo(blurred, CV_8U);
    Sampling of_blurred({20, 20}, kSize);
    of_blurred.show(view(blurred), 1);
    Eigen::VectorXf look(400);
    of_blurred.read(kState, look);
    particles::whiten(look);
    EXPECT_GT(look.dot(looks.col(number)), 0.9995F) << "template " << number;
  }
}

TEST(BlurredLooks, OfTheShortestMotionAreNearlyTheSharpOne) {
  const cv::Mat1b sharp = BlurredWorld(2).picture(kState.centre);
  Sampling sampling({20, 20}, kSize);
  sampling.show(view(sharp), 1);
  Eigen::VectorXf look(400);
  sampling.read(kState, look);
  particles::whiten(look);
  const BlurFan fan{.directions = 4, .lengths = 1, .shortest = 0.001, .longest = 0.001};
  const Eigen::MatrixXf looks = blurred_looks(sampling, kState, fan, kSize.x);
  for (int number = 0; number < fan.size(); ++number) EXPECT_NEAR(looks.col(number).dot(look), 1, 1e-4);
}

TEST(BlurFan, GoesEvenlyThroughHalfATurnAndFromTheShortestToTheLongest) {
  const BlurFan fan{.directions = 4, .lengths = 3, .shortest = 0.1, .longest = 0.5};
  ASSERT_EQ(fan.size(), 12);
  for (int number = 0; number < 12; ++number) {
    const BlurEstimate motion = fan.motion(number, 50);
    EXPECT_NEAR(motion.direction_rad, std::numbers::pi / 4 * (number / 3), 1e-12);
    EXPECT_NEAR(motion.length_px, 5 + 10 * (number % 3), 1e-12);
  }
}

}  // namespace
}  // namespace relock::blut
