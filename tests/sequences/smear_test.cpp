#include "sequences/simulator/smear.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "core/blur.h"
#include "core/random.h"
#include "tests/sequences/scratch.h"

namespace relock::simulator {
namespace {

constexpr double kPi = std::numbers::pi;

/// Soft spots, 0 to 255; nothing in it is finer than two pixels or so.
cv::Mat1f spots(int width, int height, std::uint64_t seed) {
  Random random(seed);
  cv::Mat1f picture(height, width);
  for (float& value : picture) value = static_cast<float>(255 * random.uniform());
  cv::GaussianBlur(picture, picture, {}, 1.5);
  return picture;
}

Vec2 way(double length, double angle) { return length * Vec2{std::cos(angle), std::sin(angle)}; }

/// The straightforward way: interpolate the picture of third degree at many places along the line, and take the mean.
double mean_along(const cv::Mat1f& picture, cv::Point at, Vec2 way) {
  constexpr int kSteps = 600;
  const auto weight = [](double x) {  // Keys 1981
    x = std::abs(x);
    return x < 1 ? 1.5 * x * x * x - 2.5 * x * x + 1 : x < 2 ? -0.5 * x * x * x + 2.5 * x * x - 4 * x + 2 : 0;
  };
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double t = (i + 0.5) / kSteps - 0.5, x = at.x + t * way.x, y = at.y + t * way.y;
    for (int v = cvFloor(y) - 1; v <= cvFloor(y) + 2; ++v)
      for (int u = cvFloor(x) - 1; u <= cvFloor(x) + 2; ++u)
        sum += weight(x - u) * weight(y - v) * static_cast<double>(picture(v, u));
  }
  return sum / kSteps;
}

TEST(Smear, IsTheMeanOfThePictureAlongTheLine) {
  const cv::Mat1f picture = spots(150, 120, 1);
  for (const double length : {0.7, 1.5, 4.0, 23.4, 60.0})
    for (const double angle : {0.0, 0.3, kPi / 4, 1.2, kPi / 2, 2.0, 3 * kPi / 4, 2.9, 4.0}) {
      const int margin = smear_margin(way(length, angle));
      const cv::Mat1f made = smeared(picture, way(length, angle), margin);
      ASSERT_EQ(made.size(), cv::Size(150 - 2 * margin, 120 - 2 * margin));
      for (const cv::Point at : {cv::Point(0, 0), {made.cols - 1, made.rows - 1}, {3, 5}, {made.cols / 2, 1}})
        EXPECT_NEAR(made(at), mean_along(picture, at + cv::Point(margin, margin), way(length, angle)), 1.5)
            << length << " px at " << angle;
    }
}

TEST(Smear, AgreesWithTheBlurKernelWherePicturesAreSmooth) {
  cv::Mat1f picture = spots(300, 260, 2);
  cv::GaussianBlur(picture, picture, {}, 4);
  for (const double angle : {0.0, 0.5, kPi / 4, 1.3, 2.2}) {
    const cv::Mat1f made = smeared(picture, way(64.5, angle), 60);
    cv::Mat1f kernel;
    cv::filter2D(picture, kernel, CV_32F, blur_kernel({angle, 64.5}));
    EXPECT_LT(cv::norm(made, kernel(cv::Rect(60, 60, made.cols, made.rows)), cv::NORM_INF), 0.2) << angle;
  }
}

TEST(Smear, IsTheSameForwardsAndBackwards) {
  const cv::Mat1f picture = spots(120, 100, 3);
  for (const double angle : {0.4, 1.4, 2.4})
    EXPECT_LT(cv::norm(smeared(picture, way(30, angle), 25), smeared(picture, way(30, angle + kPi), 25),
                       cv::NORM_INF),
              1e-3);
}

TEST(Smear, TurnsWithThePicture) {
  const cv::Mat1f picture = spots(110, 90, 4);
  const Vec2 along = way(31, 0.3);
  const cv::Mat1f made = smeared(picture, along, 25);
  cv::Mat1f other, back;
  cv::transpose(picture, other);
  cv::transpose(smeared(other, {along.y, along.x}, 25), back);
  EXPECT_EQ(cv::norm(made, back, cv::NORM_INF), 0);
  cv::flip(picture, other, 1);
  cv::flip(smeared(other, {-along.x, along.y}, 25), back, 1);
  EXPECT_LT(cv::norm(made, back, cv::NORM_INF), 0.5) << "mirrored left and right";
}

TEST(Smear, LeavesAnEvenPictureAsItIs) {
  const cv::Mat1f even(90, 120, 77.0F);
  for (const double angle : {0.0, 0.1, 1.0, 1.5, 2.6})
    for (const double length : {0.0, 0.3, 1.0, 2.0, 41.3})
      EXPECT_LT(cv::norm(smeared(even, way(length, angle), 30), cv::Mat1f(30, 60, 77.0F), cv::NORM_INF),
                1e-3);
}

TEST(Smear, InBinsIsTheMeanOfEachBin) {
  const cv::Mat1f picture = spots(120, 96, 5);
  for (const int bin : {2, 3})
    for (const Vec2 along : {Vec2{}, way(20, 0.4), way(20, 1.9)}) {
      cv::Mat1f means;
      const cv::Mat1f fine = smeared(picture, along, 18);
      cv::resize(fine, means, fine.size() / bin, 0, 0, cv::INTER_AREA);
      EXPECT_LT(cv::norm(smeared(picture, along, 18, bin), means, cv::NORM_INF), 1e-3) << bin;
    }
}

TEST(Smear, NamesWhatCannotBe) {
  const cv::Mat1f picture(60, 60, 1.0F);
  EXPECT_EQ(fault_of([&] { smeared(picture, {10, 0}, smear_margin({10, 0})); }), "");
  EXPECT_NE(fault_of([&] {
              smeared(picture, {10, 0}, 4);
            }).find("cannot have a margin of 4 px"),
            std::string::npos);
  EXPECT_NE(fault_of([&] { smeared(picture, {}, 30); }).find("margin of 30 px"), std::string::npos);
  EXPECT_NE(fault_of([&] { smeared(picture, {}, 10, 3); }).find("bins of 3 px"), std::string::npos);
}

}  // namespace
}  // namespace relock::simulator
