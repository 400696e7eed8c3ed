#pragma once

#include <opencv2/core/mat.hpp>

#include "core/geometry.h"
#include "core/random.h"

namespace relock::simulator {

/// What is behind the target of a still: a gradient with grain of several octaves, and on it 20 to 160 things (that
/// for 640x480; more in larger pictures, with the square root of their area) of 6 to 110 px radius, one over the
/// other: ellipses, hoops, slabs, shards, bars, gratings, writing, checks, posters (clutter.h), pieces of brick, wood
/// and landscape, and ring targets of random radii, which are what most looks like a marker and is none.
///
/// `area`: of which a picture is made, px from the top left CORNER of the picture's first pixel; it may reach
/// outside the picture. Of whole px. `texels_per_px`: how finely, a whole number. CV_8UC1. The same `random`, the same
/// jumble, whatever part of it is asked for.
cv::Mat1b jumble(Size picture, const cv::Rect& area, int texels_per_px, const Random& random);

}  // namespace relock::simulator
