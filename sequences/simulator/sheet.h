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
/// A pixel is the mean of 2x2 places spread over it, and of up to 16x16 where the sheet is foreshortened: from one to
/// the next, the sheet moves on by 1.5 samples at most. Before, these are made of the sheet's own by averaging, about
/// as large as half a pixel where it is least reduced. Its edge is averaged, too. What is behind the camera is
/// not drawn.
void draw_sheet(const PrintedTarget& target, const Eigen::Matrix3d& to_picture, const Tones& tones,
                cv::Mat1f& picture);

}  // namespace relock::simulator
