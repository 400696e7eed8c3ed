#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/random.h"
#include "sequences/simulator/painting.h"

namespace relock::simulator {

/// A printed sheet of `size` (m) with something on it that is hard for detectors of fiducials: circles, targets,
/// blinds, grids, text, checkerboards, crosses; or a picture of a landscape.
Canvas poster(const cv::Size2d& size, double texels_per_m, Random random);

/// What is printed on a poster.
enum class Print : std::uint8_t { circles, target, blinds, grid, text, checkerboard, crosses, landscape };

/// A poster of that kind.
Canvas poster(Print print, const cv::Size2d& size, double texels_per_m, Random random);

/// A sheet that hangs somewhere, perhaps a little askew.
struct Hanging {
  cv::Point2d middle;  ///< m from the wall's top left corner
  cv::Size2d size;     ///< m
  double turn = 0;     ///< rad, from x towards y

  /// The upright rectangle around it.
  cv::Rect2d bounds() const;
};

struct HangingPlan {
  int count = 0;  ///< fewer where there is no more room
  double smallest_m = 0.15, largest_m = 0.5;
  cv::Rect2d area;       ///< they hang in here, m
  cv::Rect2d preferred;  ///< every other one in here if possible; without area: none
};

/// Finds places; none overlaps another or one of `taken`.
std::vector<Hanging> hang(const HangingPlan& plan, std::vector<cv::Rect2d> taken, Random random);

}  // namespace relock::simulator
