#pragma once

#include <array>
#include <opencv2/core/mat.hpp>

namespace relock::ring_paper {

/// The filters of section 3.3, "Gabor filter".
struct GaborPlan {
  double wavelength_px = 8;  ///< lambda
  double aspect = 0.5;       ///< gamma: how much narrower the window is across the waves than along them
  double spread = 0.56;      ///< sigma, in wavelengths
  int kernel_px = 55;        ///< side of the kernel, odd
};

/// The kernel as the paper's reference has it, CV_64FC1, y down:
///
///     exp(-(u^2 + gamma^2 v^2) / (2 sigma^2)) cos(2 pi u / lambda + psi)
///     u = x cos(theta) + y sin(theta),  v = -x sin(theta) + y cos(theta)
cv::Mat1d gabor_kernel(const GaborPlan& plan, double theta_rad, double psi_rad);

/// The l2 norm of the outputs of all filters, pixel by pixel.
///
/// The paper has eight orientations, every 45 degrees, and two phases, psi = 0 and pi/2. Turning a filter by 180
/// degrees turns u into -u, which leaves the cosine as it is and changes the sign of the sine: the squares are
/// the same twice. So four orientations are computed, and the norm is smaller by the factor sqrt(2), which the
/// normalisation that follows takes out.
class GaborBank {
 public:
  explicit GaborBank(const GaborPlan& plan);

  /// The norm for a picture of any size, mirrored at its border about the outermost pixels as cv::filter2D does
  /// it. Good until the next call. By Fourier transform: equal to cv::filter2D but for rounding.
  const cv::Mat1f& norm(const cv::Mat1b& picture);

  /// The norm beside a straight, upright edge between two pixels, for each grey level that it steps.
  double of_edge() const { return of_edge_; }

 private:
  static constexpr int kOrientations = 4;

  void prepare(cv::Size padded);
  void add_squares(cv::Size picture);

  GaborPlan plan_;
  double of_edge_;
  std::array<cv::Mat1f, kOrientations> spectra_;  // of the kernels, for pictures padded to the same size
  cv::Mat1f padded_, norm_;
  cv::Mat2f spectrum_, response_;
};

}  // namespace relock::ring_paper
