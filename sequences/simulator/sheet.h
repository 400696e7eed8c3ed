#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include <array>

#include "core/printed_target.h"

namespace relock::simulator {

/// Throws Error unless the target's picture is a square one of grey levels, and its sheet no smaller than it is.
void check_sheet(const PrintedTarget& target);

/// What grey levels of a sheet become where it is seen.
using Tones = std::array<float, 256>;

/// Draws a target's sheet, all of it, over `picture` (CV_32FC1). `to_picture`: from places on the sheet (m right and
/// down of its middle, and 1) to homogeneous pixels, centres at integers.
///
/// A pixel is the mean of at least 2x2 places spread over it, of more where the sheet is foreshortened: so many that
/// the sheet moves on by at most one sample from one to the next, after it was averaged to samples as large as that
/// in the direction that is least reduced. Its edge is averaged, too. What is behind the camera is not drawn.
void draw_sheet(const PrintedTarget& target, const Eigen::Matrix3d& to_picture, const Tones& tones,
                cv::Mat1f& picture);

}  // namespace relock::simulator
