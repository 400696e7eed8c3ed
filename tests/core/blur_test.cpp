#include "core/blur.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "core/error.h"

namespace relock {
namespace {

using std::numbers::pi;

/// Sum, mean from the middle and central second moments of a kernel.
struct Moments {
  double sum = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
};

Moments moments_of(const cv::Mat1f& kernel) {
  Moments m;
  for (int row = 0; row < kernel.rows; ++row)
    for (int column = 0; column < kernel.cols; ++column) {
      const double w = kernel(row, column), x = column - kernel.cols / 2, y = row - kernel.rows / 2;
      m.sum += w, m.x += w * x, m.y += w * y;
      m.xx += w * x * x, m.xy += w * x * y, m.yy += w * y * y;
    }
  return m;
}

/// The mean of f (1 - f) over -reach … reach, summed naively.
double bilinear_share(double reach) {
  constexpr int kPoints = 20000;
  double sum = 0;
  for (int i = 0; i < kPoints; ++i) {
    const double at = reach * (2 * (i + 0.5) / kPoints - 1), f = at - std::floor(at);
    sum += f * (1 - f);
  }
  return sum / kPoints;
}

const std::vector<BlurEstimate> kBlurs{{0, 0},     {0, 1},           {0, 7.3},    {pi / 2, 7.3},
                                       {0.4, 0.2}, {0.4, 3.14},      {2.5, 12.5}, {pi / 4, 50},
                                       {1.1, 80},  {2 * pi / 3, 33}, {3, 2},      {pi / 2, 1e-9}};

TEST(BlurKernel, AddsUpToOneWithItsMeanInTheMiddle) {
  for (const BlurEstimate& blur : kBlurs) {
    const cv::Mat kernel = blur_kernel(blur);
    EXPECT_EQ(kernel.type(), CV_32FC1);
    EXPECT_EQ(kernel.cols % 2 + kernel.rows % 2, 2);
    const Moments m = moments_of(kernel);
    EXPECT_NEAR(m.sum, 1, 1e-6) << blur.length_px;
    EXPECT_NEAR(m.x, 0, 1e-6);
    EXPECT_NEAR(m.y, 0, 1e-6);
  }
}

TEST(BlurKernel, HasTheCovarianceOfTheLineAndTheBilinearShare) {
  for (const BlurEstimate& blur : kBlurs) {
    const Moments m = moments_of(blur_kernel(blur));
    const double c = std::cos(blur.direction_rad), s = std::sin(blur.direction_rad);
    const double line = blur.length_px * blur.length_px / 12;
    const double tolerance = 1e-5 * (1 + line);
    EXPECT_NEAR(m.xx, line * c * c + bilinear_share(blur.length_px / 2 * std::abs(c)), tolerance);
    EXPECT_NEAR(m.yy, line * s * s + bilinear_share(blur.length_px / 2 * std::abs(s)), tolerance);
    EXPECT_NEAR(m.xy, line * c * s, tolerance) << "positive from +x towards +y, where y is down";
  }
}

TEST(BlurKernel, IsTheSameWhenTurnedByHalfATurn) {
  for (const BlurEstimate& blur : kBlurs) {
    const cv::Mat kernel = blur_kernel(blur);
    cv::Mat turned;
    cv::flip(kernel, turned, -1);
    EXPECT_EQ(cv::norm(kernel, turned, cv::NORM_INF), 0);
    BlurEstimate backwards = blur;
    backwards.direction_rad += pi;
    EXPECT_NEAR(cv::norm(kernel, blur_kernel(backwards), cv::NORM_INF), 0, 1e-7);
  }
}

TEST(BlurKernel, OfNoMotionIsASingleOne) {
  const cv::Mat1f kernel = blur_kernel({1.2, 0});
  ASSERT_EQ(kernel.size(), cv::Size(1, 1));
  EXPECT_EQ(kernel(0, 0), 1);
}

TEST(BlurKernel, BlursAsTheMeanOfManyShiftedCopiesDoes) {
  const auto bump = [](double x, double y) {
    return std::exp(-(x * x + y * y) / 200) + 0.3 * std::sin(0.1 * x + 0.05 * y);
  };
  const int half = 32;
  cv::Mat1d picture(2 * half + 1, 2 * half + 1);
  for (int y = -half; y <= half; ++y)
    for (int x = -half; x <= half; ++x) picture(y + half, x + half) = bump(x - 2.5, y + 1.25);
  for (const BlurEstimate& blur : {BlurEstimate{0.7, 9}, BlurEstimate{2.0, 4.4}, BlurEstimate{0, 6}}) {
    cv::Mat1d blurred;
    cv::filter2D(picture, blurred, CV_64F, blur_kernel(blur));
    for (const cv::Point at : {cv::Point(0, 0), cv::Point(7, -3), cv::Point(-12, 10)}) {
      double mean = 0;
      for (int i = 0; i < 1000; ++i) {
        const double along = blur.length_px * ((i + 0.5) / 1000 - 0.5);
        mean += bump(at.x - 2.5 - along * std::cos(blur.direction_rad),
                     at.y + 1.25 - along * std::sin(blur.direction_rad)) /
                1000;
      }
      // What is left is the curvature of the picture times half the bilinear share.
      EXPECT_NEAR(blurred(at.y + half, at.x + half), mean, 0.25 / 2 * 2 * 0.012);
    }
  }
}

TEST(BlurKernel, RefusesWhatIsNoMotion) {
  EXPECT_THROW(blur_kernel({0, -1}), Error);
  EXPECT_THROW(blur_kernel({0, NAN}), Error);
  EXPECT_THROW(blur_kernel({INFINITY, 3}), Error);
  EXPECT_THROW(blur_kernel({0, 1e9}), Error);
}

}  // namespace
}  // namespace relock
