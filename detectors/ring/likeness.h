#pragma once

#include <opencv2/core/mat.hpp>

#include "detectors/ring/exposure.h"

namespace relock::ring {

/// How like a marker of this code and view the picture is: the correlation of the two, but for what leaks
/// in from around the sheet, on 64 points spread evenly over the disc, to 1; -1 where too few of them are in the picture.
/// Quick: for choosing among many views, not for judging one. Quicker and rougher on `one_point_of` so many.
double likeness(const cv::Mat& gray, RingModel& model, std::size_t code, const View& view, double psf_px,
                std::size_t one_point_of = 1);

}  // namespace relock::ring
