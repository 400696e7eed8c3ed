#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

namespace relock::simulator {

/// Detail without a scale of its own, as natural surfaces have it: random lattices, each finer by half, added
/// up with falling strength. A function of the place alone: two pictures of overlapping areas agree.
struct Grain {
  std::uint64_t seed = 0;
  double coarsest_m = 1.0;  ///< distance between lattice points of the first octave
  double finest_m = 0.004;  ///< no octave finer than this
  double fall = 0.75;       ///< strength of an octave relative to the one before
  double stretch = 1.0;     ///< along x: above 1 the grain runs along x
};

/// The grain over `area` (m, wherever the caller's origin is) as a picture of `size`: CV_32FC1, mean about 0,
/// standard deviation about 1. Octaves that the pixels cannot show are left out.
cv::Mat grain_over(const Grain& grain, const cv::Rect2d& area, const cv::Size& size);

/// A number in [0, 1) that belongs to a cell, of bricks or planks.
double number_of_cell(std::uint64_t seed, std::int64_t column, std::int64_t row);

}  // namespace relock::simulator
