#pragma once

#include <opencv2/core.hpp>

#include "core/geometry.h"
#include "detectors/ring_marker.h"

namespace relock {

/// A ring marker seen straight on while it moves.
struct DrawnRing {
  Vec2 centre;
  double radius_px = 50;
  Vec2 blur = {};  ///< from start to end of the exposure, px
  double black = 30, white = 210;
};

/// Draws it on what is in `picture`, out to its sheet's edge: every pixel the mean over its area and the exposure.
void draw(cv::Mat1b& picture, const RingMarker& marker, const DrawnRing& drawn);

}  // namespace relock
