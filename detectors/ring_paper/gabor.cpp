#include "detectors/ring_paper/gabor.h"

#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>

namespace relock::ring_paper {
namespace {

using std::numbers::pi;

double theta_of(std::size_t orientation) { return static_cast<double>(orientation) * pi / 4; }

/// Both phases at once as one complex kernel; its values at opposite points are conjugate, because the cosine is
/// even and the sine odd. So its spectrum is real.
cv::Mat2f complex_kernel(const GaborPlan& plan, double theta) {
  cv::Mat both;
  cv::merge(std::vector<cv::Mat>{gabor_kernel(plan, theta, 0), gabor_kernel(plan, theta, pi / 2)}, both);
  both.convertTo(both, CV_32FC2);
  return both;
}

/// The spectrum by which a transformed picture is multiplied to be correlated with the kernel.
cv::Mat1f spectrum_of(const cv::Mat2f& kernel, cv::Size padded) {
  const int reach = kernel.rows / 2;
  cv::Mat2f spread(padded, cv::Vec2f(0, 0));
  for (int y = -reach; y <= reach; ++y)
    for (int x = -reach; x <= reach;
         ++x)  // opposite points: correlation is convolution with the turned kernel
      spread((padded.height + y) % padded.height, (padded.width + x) % padded.width) +=
          kernel(reach - y, reach - x);
  cv::dft(spread, spread, cv::DFT_SCALE);  // the scale of the way there and back
  cv::Mat1f real;
  cv::extractChannel(spread, real, 0);
  return real;
}

double norm_of_edge(const GaborPlan& plan) {
  double squares = 0;
  for (std::size_t i = 0; i < 4; ++i)
    for (const double psi : {0.0, pi / 2}) {
      const cv::Mat1d kernel = gabor_kernel(plan, theta_of(i), psi);
      squares += std::pow(cv::sum(kernel.colRange(kernel.cols / 2, kernel.cols))[0], 2);
    }
  return std::sqrt(squares);
}

}  // namespace

cv::Mat1d gabor_kernel(const GaborPlan& plan, double theta_rad, double psi_rad) {
  const int reach = plan.kernel_px / 2;
  const double sigma = plan.spread * plan.wavelength_px;
  const double c = std::cos(theta_rad), s = std::sin(theta_rad);
  cv::Mat1d kernel(2 * reach + 1, 2 * reach + 1);
  for (int y = -reach; y <= reach; ++y)
    for (int x = -reach; x <= reach; ++x) {
      const double u = x * c + y * s, v = plan.aspect * (-x * s + y * c);
      kernel(reach + y, reach + x) = std::exp(-(u * u + v * v) / (2 * sigma * sigma)) *
                                     std::cos(2 * pi * u / plan.wavelength_px + psi_rad);
    }
  return kernel;
}

GaborBank::GaborBank(const GaborPlan& plan) : plan_(plan), of_edge_(norm_of_edge(plan)) {}

void GaborBank::prepare(cv::Size padded) {
  if (spectra_[0].size() == padded) return;
  for (std::size_t i = 0; i < spectra_.size(); ++i)
    spectra_[i] = spectrum_of(complex_kernel(plan_, theta_of(i)), padded);
}

void GaborBank::add_squares(cv::Size picture) {
  const int reach = plan_.kernel_px / 2;
  for (int y = 0; y < picture.height; ++y) {
    const cv::Vec2f* from = response_[reach + y] + reach;
    float* to = norm_[y];
    for (int x = 0; x < picture.width; ++x) to[x] += from[x][0] * from[x][0] + from[x][1] * from[x][1];
  }
}

const cv::Mat1f& GaborBank::norm(const cv::Mat1b& picture) {
  const int reach = plan_.kernel_px / 2;
  const cv::Size padded(cv::getOptimalDFTSize(picture.cols + 2 * reach),
                        cv::getOptimalDFTSize(picture.rows + 2 * reach));
  prepare(padded);
  cv::Mat1b mirrored;
  cv::copyMakeBorder(picture, mirrored, reach, padded.height - picture.rows - reach, reach,
                     padded.width - picture.cols - reach, cv::BORDER_REFLECT_101 | cv::BORDER_ISOLATED);
  mirrored.convertTo(padded_, CV_32F);
  cv::dft(padded_, spectrum_, cv::DFT_COMPLEX_OUTPUT);
  norm_.create(picture.size());
  norm_ = 0.0F;
  response_.create(padded);
  for (const cv::Mat1f& kernel : spectra_) {
    for (int y = 0; y < padded.height; ++y) {
      const cv::Vec2f* from = spectrum_[y];
      const float* factor = kernel[y];
      cv::Vec2f* to = response_[y];
      for (int x = 0; x < padded.width; ++x) to[x] = factor[x] * from[x];
    }
    cv::idft(response_, response_);
    add_squares(picture.size());
  }
  cv::sqrt(norm_, norm_);
  return norm_;
}

}  // namespace relock::ring_paper
