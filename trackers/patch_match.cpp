#include "trackers/patch_match.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace relock {
namespace {

constexpr double kLeastContrast = 2;       // grey levels, standard deviation: of the patch
constexpr double kLeastFoundContrast = 1;  // and of what is found, which blur may have made weaker

double contrast(const cv::Mat& pixels) {
  cv::Scalar mean, deviation;
  cv::meanStdDev(pixels, mean, deviation);
  return deviation[0];
}

/// Where between its neighbours the top of a parabola through three equally spaced values lies, in [-0.5,
/// 0.5].
double parabola_top(double before, double at, double after) {
  const double bend = before - 2 * at + after;
  return bend < 0 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0.0;
}

}  // namespace

void PatchMatcher::set(const cv::Mat& picture, const cv::Rect& place) {
  patch_.release();
  if (!place.empty() && contrast(picture(place)) >= kLeastContrast) picture(place).copyTo(patch_);
}

std::optional<PatchMatcher::Match> PatchMatcher::find(const cv::Mat& picture, cv::Rect window,
                                                      double least_correlation) {
  window &= cv::Rect({}, picture.size());
  if (!usable() || window.width < patch_.cols || window.height < patch_.rows) return std::nullopt;
  cv::matchTemplate(picture(window), patch_, correlations_, cv::TM_CCOEFF_NORMED);
  cv::patchNaNs(correlations_, -1);
  cv::Point best;
  double correlation = 0;
  cv::minMaxLoc(correlations_, nullptr, &correlation, nullptr, &best);
  if (!(correlation > 0 && correlation >= least_correlation)) return std::nullopt;
  // Where the picture is flat, OpenCV divides rounding errors by each other.
  if (contrast(picture(cv::Rect(window.tl() + best, patch_.size()))) < kLeastFoundContrast)
    return std::nullopt;
  const auto at = [&](int dx, int dy) { return double{correlations_(best.y + dy, best.x + dx)}; };
  Match match{{static_cast<double>(window.x + best.x), static_cast<double>(window.y + best.y)},
              std::min(correlation, 1.0)};
  if (best.x > 0 && best.x + 1 < correlations_.cols)
    match.corner.x += parabola_top(at(-1, 0), at(0, 0), at(1, 0));
  if (best.y > 0 && best.y + 1 < correlations_.rows)
    match.corner.y += parabola_top(at(0, -1), at(0, 0), at(0, 1));
  return match;
}

}  // namespace relock
