#pragma once

#include <Eigen/Core>

#include "trackers/particles/sampling.h"

namespace relock::blut {

/// The largest connected piece of the grid that no template explains, as a part of the grid, as L1-APG tells
/// occlusion: samples whose trivial coefficient is larger than `level` standard deviations of a look, small holes
/// between them closed.
double occluded_share(const Eigen::Ref<const Eigen::VectorXf>& trivial, particles::Grid grid, double level);

}  // namespace relock::blut
