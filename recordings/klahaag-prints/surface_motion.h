// How a piece of the scene moves through a clip, seen from its own texture.
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <vector>

namespace recordings {

/// The motion of one surface: for every frame the affine map from frame 0 to it.
struct SurfaceMotion {
  std::vector<cv::Matx33d> from_first;  ///< from_first[0] is the identity
  double jitter_px = 0;  ///< noise of one frame-to-frame step at the surface's centre, one sigma
  double features = 0;   ///< matched per step, mean
};

/// Follows the texture inside `surface` (px in frame 0): corners are found anew in every frame, matched to
/// the next by optical flow that must lead back to where it started, and fitted by one affine map with robust
/// weights. The steps are chained and not smoothed: the camera's own shake is wanted.
/// The jitter is measured: every second feature is fitted apart, and the two answers are compared.
SurfaceMotion follow_surface(const std::vector<std::filesystem::path>& frames, const cv::Rect& surface);

}  // namespace recordings
