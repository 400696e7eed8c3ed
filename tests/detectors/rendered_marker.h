#pragma once

#include <opencv2/core.hpp>

#include "core/geometry.h"
#include "detectors/marker_cells.h"

namespace relock {

/// A grey picture of a print on a grey wall whose outline, as a detector should report it, is exactly
/// `outline`. Every pixel is the average of the wall and the print over its area.
cv::Mat1b rendered_marker(const MarkerCells& print, const Quad& outline, Size picture);

/// The same, drawn into a picture that is there already.
void render_into(cv::Mat1b& picture, const MarkerCells& print, const Quad& outline);

/// A square of the given side, turned clockwise (as seen in the picture) about its centre.
Quad square(Vec2 centre, double side, double turned_rad = 0);
/// A square that is tilted: its right side is farther away.
Quad tilted(Vec2 centre, double side);

/// The picture as motion along x over `length` px blurs it.
cv::Mat1b blurred_along_x(const cv::Mat1b& picture, int length);

/// The picture with its grey repeated in three channels.
cv::Mat3b bgr_of(const cv::Mat1b& gray);

}  // namespace relock
