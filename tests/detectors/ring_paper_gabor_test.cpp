#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "detectors/ring_paper/gabor.h"
#include "tests/detectors/drawn_rings.h"

namespace relock::ring_paper {
namespace {

using std::numbers::pi;

cv::Mat1b grating(cv::Size size, double wavelength, double direction, double amplitude) {
  cv::Mat1b picture(size);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      picture(y, x) = cv::saturate_cast<std::uint8_t>(
          128 +
          amplitude * std::cos(2 * pi / wavelength * (x * std::cos(direction) + y * std::sin(direction))));
  return picture;
}

/// The square of one filter's two outputs on a grating of unit amplitude, without end: the Fourier transform of the
/// Gaussian window at the difference (and, nearly nothing, at the sum) of both frequencies. The mean over the
/// grating's phases.
double squared_output(const GaborPlan& plan, double theta, double wavelength, double direction) {
  const double sigma = plan.spread * plan.wavelength_px, f = 2 * pi / plan.wavelength_px,
               k = 2 * pi / wavelength;
  const double along = k * std::cos(direction - theta),
               across = k * std::sin(direction - theta) / plan.aspect;
  const auto window = [&](double u) {
    return 2 * pi * sigma * sigma / plan.aspect * std::exp(-sigma * sigma * (u * u + across * across) / 2);
  };
  return (std::pow(window(along - f), 2) + std::pow(window(along + f), 2)) / 4;
}

TEST(GaborBank, RespondsToAGratingAsTheClosedFormulaSays) {
  const GaborPlan plan;
  GaborBank bank(plan);
  for (const double wavelength : {6.0, 8.0, 11.0, 16.0})
    for (const double degrees : {0.0, 20.0, 45.0, 75.0, 90.0, 130.0}) {
      const double direction = degrees * pi / 180;
      double expected = 0;
      for (int i = 0; i < 4; ++i) expected += squared_output(plan, i * pi / 4, wavelength, direction);
      const cv::Mat1b flat(160, 160, std::uint8_t{128});
      const cv::Mat1f norm = bank.norm(grating({160, 160}, wavelength, direction, 100)).clone();
      const cv::Mat1f inner = norm(cv::Rect(40, 40, 80, 80));
      // What the window cuts off beyond three sigma and the 0.2 % that the cosine answers to even light remain.
      EXPECT_NEAR(std::sqrt(cv::mean(inner.mul(inner))[0]), 100 * std::sqrt(expected),
                  0.02 * 255 * bank.of_edge())
          << wavelength << " px at " << degrees;
    }
}

/// The eight orientations and two phases of the paper, by OpenCV's own filter.
cv::Mat1f direct_norm(const GaborPlan& plan, const cv::Mat1b& picture) {
  cv::Mat1d squares(picture.size(), 0.0);
  for (int i = 0; i < 8; ++i)
    for (const double psi : {0.0, pi / 2}) {
      cv::Mat1d output;
      cv::filter2D(picture, output, CV_64F, gabor_kernel(plan, i * pi / 4, psi));
      squares += output.mul(output);
    }
  cv::sqrt(squares, squares);
  cv::Mat1f norm;
  squares.convertTo(norm, CV_32F);
  return norm;
}

TEST(GaborBank, IsTheNormOfAllSixteenFiltersOfThePaperButForTheSquareRootOfTwo) {
  cv::Mat1b noise(90, 130, std::uint8_t{128});
  add_noise(noise, 60, 3);
  const GaborPlan plan;
  GaborBank bank(plan);
  for (const cv::Mat1b& picture :
       {blurred_rings("10", 80, {0.7, 20}, 150), noise, cv::Mat1b(noise(cv::Rect(7, 5, 61, 40))),
        cv::Mat1b(noise(cv::Rect(0, 0, 20, 9)))}) {  // the last one is smaller than the kernel
    const cv::Mat1f direct =
        direct_norm(plan, picture.clone());  // a clone: filter2D looks beyond a part's border
    const double apart = cv::norm(bank.norm(picture), direct / std::sqrt(2), cv::NORM_INF);
    EXPECT_LT(apart, 1e-3 * 255 * bank.of_edge()) << picture.size();
  }
}

TEST(GaborKernel, IsWhatOpenCVMakes) {
  const GaborPlan plan;
  for (const double psi : {0.0, pi / 2}) {
    // OpenCV turns the other way round and fills the kernel from its end: the same at the opposite point.
    const cv::Mat theirs = cv::getGaborKernel({55, 55}, plan.spread * plan.wavelength_px, pi / 4,
                                              plan.wavelength_px, plan.aspect, psi, CV_64F);
    cv::Mat1d ours = gabor_kernel(plan, pi / 4, psi);
    cv::Mat1d turned;
    cv::flip(ours, turned, -1);
    EXPECT_LT(std::min(cv::norm(theirs, ours, cv::NORM_INF), cv::norm(theirs, turned, cv::NORM_INF)), 1e-12)
        << psi;
  }
}

TEST(GaborBank, GivesTheSameWhateverWasFilteredBefore) {
  GaborBank bank{GaborPlan{}}, other{GaborPlan{}};
  const cv::Mat1b small = blurred_rings("01", 40, {0, 5}, 80), large = blurred_rings("11", 80, {1, 9}, 130);
  const cv::Mat1f first = bank.norm(small).clone();
  bank.norm(large);
  EXPECT_EQ(cv::norm(bank.norm(small), first, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(other.norm(small), first, cv::NORM_INF), 0);
}

}  // namespace
}  // namespace relock::ring_paper
