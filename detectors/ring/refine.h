#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "detectors/ring/fit.h"

namespace relock::ring {

/// A fit to every pixel there is, and how sure it is.
struct Refined {
  Fit fit;
  /// Of the unknowns in the order of `Unknown`, px and grey levels, from the residuals' own scatter: pixels are taken for
  /// independent, and the model for right.
  Eigen::Matrix<double, kUnknowns, kUnknowns> covariance;
};

/// Goes on from `fit` with all pixels of `gray` that see the marker, by Ceres. A look of the detector fits some hundred
/// pixels, which is enough to read a marker; this is for who wants its place. Nothing when it comes to no end.
std::optional<Refined> refine(const cv::Mat& gray, RingModel& model, std::size_t code, const Fit& fit,
                              double psf_px);

}  // namespace relock::ring
