#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>

#include "core/geometry.h"

namespace relock {

/// Pixels that are searched for, and the buffer for it. A patch without contrast is never found: it looks
/// like everything.
class PatchMatcher {
 public:
  struct Match {
    Vec2 corner;             ///< centre of the patch's top left pixel, to a part of a pixel
    double correlation = 0;  ///< normalised, in (0, 1]
  };

  /// Copies the pixels of `picture` (grey) within `place`.
  void set(const cv::Mat& picture, const cv::Rect& place);
  bool usable() const { return !patch_.empty(); }
  const cv::Mat& patch() const { return patch_; }

  /// The place in `picture` within `window` that looks most like the patch; nothing if the patch does not fit
  /// into the window, has no contrast, or correlates nowhere by at least `least_correlation`. The part of a
  /// pixel is the top of a parabola through the neighbouring correlations.
  std::optional<Match> find(const cv::Mat& picture, cv::Rect window, double least_correlation);

 private:
  cv::Mat patch_;
  cv::Mat1f correlations_;
};

}  // namespace relock
