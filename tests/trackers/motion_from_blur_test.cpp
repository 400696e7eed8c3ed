#include "trackers/blut/motion_from_blur.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace relock::blut {
namespace {

constexpr double kPi = std::numbers::pi;
const BlurFan kFan{.directions = 8, .lengths = 8, .shortest = 0.05, .longest = 0.40};
constexpr double kWidth = 100;

Eigen::VectorXf none() { return Eigen::VectorXf::Zero(kFan.size()); }
int number(int direction, int length) { return direction * kFan.lengths + length; }

TEST(MotionFromBlur, OfOneBlurTemplateIsItsMotion) {
  for (int i = 0; i < kFan.directions; ++i)
    for (int j = 2; j < kFan.lengths; ++j) {
      Eigen::VectorXf c = none();
      c[number(i, j)] = 0.7F;
      const auto motion = motion_from_blur(kFan, kWidth, c, 0, {});
      ASSERT_TRUE(motion);
      EXPECT_NEAR(std::remainder(motion->direction_rad - kPi * i / 8, kPi), 0, 1e-6);
      EXPECT_NEAR(motion->length_px, 5 * (j + 1), 1e-4);
    }
}

TEST(MotionFromBlur, IsBetweenTwoDirectionsThatShareIt) {
  Eigen::VectorXf c = none();
  c[number(0, 5)] = c[number(7, 5)] = 0.4F;  // 0 and 157.5 degrees, which are neighbours
  const auto motion = motion_from_blur(kFan, kWidth, c, 0, {});
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->direction_rad, kPi * 7.5 / 8, 1e-6);
  EXPECT_LT(motion->direction_rad, kPi);
}

TEST(MotionFromBlur, IsOneThatSpreadsAsFarAsSharpAndBlurredTemplatesTogether) {
  Eigen::VectorXf c = none();
  c[number(3, 7)] = 0.5F;
  const auto motion = motion_from_blur(kFan, kWidth, c, 0.5, {});
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->length_px, 40 / std::sqrt(2.0), 1e-4);
  const auto mean = motion_from_blur(kFan, kWidth, c, 0.5, {.length = BlurReading::Length::mean});
  ASSERT_TRUE(mean);
  EXPECT_NEAR(mean->length_px, 40, 1e-4);
}

TEST(MotionFromBlur, IsNoneOfASharpTargetNorOfOneWhoseBlurIsShorterThanTheLeast) {
  Eigen::VectorXf c = none();
  EXPECT_FALSE(motion_from_blur(kFan, kWidth, c, 1, {}));
  EXPECT_FALSE(motion_from_blur(kFan, kWidth, c, 0, {}));
  c[number(2, 4)] = 0.3F;
  EXPECT_FALSE(motion_from_blur(kFan, kWidth, c, 0.6, {}));
  EXPECT_TRUE(motion_from_blur(kFan, kWidth, c, 0.3, {}));
  Eigen::VectorXf shortest = none();
  shortest[number(2, 0)] = 1;
  EXPECT_FALSE(motion_from_blur(kFan, kWidth, shortest, 0, {}));
}

TEST(MotionFromBlur, TurnsAndGrowsWithTheTarget) {
  const particles::State state{.scale = 2, .rotation_rad = 0.9 * kPi};
  const BlurEstimate seen = seen_at(state, {.direction_rad = 0.3 * kPi, .length_px = 12});
  EXPECT_NEAR(seen.direction_rad, 0.2 * kPi, 1e-9);
  EXPECT_NEAR(seen.length_px, 24, 1e-9);
}

TEST(MotionFromBlur, TakesFansOfOneAndTwoDirections) {
  for (const int directions : {1, 2}) {
    const BlurFan fan{.directions = directions, .lengths = 1, .shortest = 0.2, .longest = 0.2};
    Eigen::VectorXf c = Eigen::VectorXf::Constant(fan.size(), 0.1F);
    c[0] = 1;
    const auto motion = motion_from_blur(fan, kWidth, c, 0, {});
    ASSERT_TRUE(motion);
    EXPECT_NEAR(motion->direction_rad, 0, 1e-6);
    EXPECT_NEAR(motion->length_px, 20, 1e-4);
  }
}

}  // namespace
}  // namespace relock::blut
