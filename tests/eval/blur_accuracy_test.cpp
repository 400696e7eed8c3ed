#include "eval/scores/blur_accuracy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace relock {
namespace {

constexpr double kPi = std::numbers::pi;

/// A Hit on a target of 100 px.
Fix fix(const std::optional<BlurVector>& truth, const std::optional<BlurEstimate>& told) {
  Fix one;
  one.size_px = 100;
  one.blur = truth;
  one.told_blur = told;
  return one;
}

BlurVector at(double angle_rad, double length_px) {
  return length_px * Vec2{std::cos(angle_rad), std::sin(angle_rad)};
}

TEST(BlurAccuracy, IsThatOfTheAxisWhateverItsSense) {
  for (const double truth : {0.0, 1.0, 2.5, kPi, 4.0, 6.0})
    for (const double off : {0.0, 0.2, 1.5}) {
      const double told = std::fmod(truth + off, kPi);
      const BlurAccuracy one = blur_accuracy(std::vector{fix(at(truth, 20), BlurEstimate{told, 25})});
      EXPECT_NEAR(*one.direction_median_deg, off * 180 / kPi, 1e-4) << truth << ' ' << off;
      EXPECT_NEAR(*one.length_median_percent, 25, 1e-9);
    }
}

TEST(BlurAccuracy, CountsWhatIsBlurredWhatIsSharpAndNothingInBetween) {
  const BlurEstimate longer{0, 11}, shorter{0, 9};
  const std::vector<Fix> all{fix(at(0, 10), longer), fix(at(0, 50), {}),     fix(at(0, 7), longer),
                             fix(at(0, 5), longer),  fix(at(0, 0), shorter), fix(at(1, 1), {}),
                             fix({}, longer)};
  const BlurAccuracy of = blur_accuracy(all);
  EXPECT_EQ(of.blurred, 2U);
  EXPECT_EQ(of.told, 1U);
  EXPECT_EQ(of.sharp, 3U);
  EXPECT_EQ(of.sharp_blurred, 1U);
}

TEST(BlurAccuracy, IsNotTellableWhereNothingWasTold) {
  const BlurAccuracy of = blur_accuracy(std::vector{fix(at(0, 30), {}), fix(at(0, 0), {})});
  EXPECT_EQ(of.blurred, 1U);
  EXPECT_FALSE(of.direction_median_deg || of.length_p95_percent);
}

}  // namespace
}  // namespace relock
