#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/sighting.h"
#include "trackers/particles/sampling.h"

namespace relock::blut {

/// Straight, even motions over the exposure: all `lengths` of the first direction, then of the next.
struct BlurFan {
  int directions = 8;  ///< evenly over half a turn: a blur does not tell its sense
  int lengths = 8;
  double shortest = 0.05;  ///< of the target's width
  double longest = 0.40;

  int size() const { return directions * lengths; }
  /// `number`: of the template; `width_px`: of the target.
  BlurEstimate motion(int number, double width_px) const;
};

/// How the target at `state` in the picture shown to `sampling` would look if it, and what is around it, had moved
/// during the exposure: whitened, a column for each motion of the fan. It is what convolving the picture with
/// blur_kernel() (core/blur.h) and then reading it gives, within the rounding of a grey level.
///
/// Every template is a mean over a line, and the lines of one direction lie within each other. So the picture is
/// read at 65 places along the longest line only, and sums of these are the templates: 8 x 65 readings in place of
/// 64 convolutions.
Eigen::MatrixXf blurred_looks(const particles::Sampling& sampling, const particles::State& state,
                              const BlurFan& fan, double width_px);

}  // namespace relock::blut
