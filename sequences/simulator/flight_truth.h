#pragma once

#include <vector>

#include "core/truth.h"
#include "sequences/simulator/exposure.h"
#include "sequences/simulator/scene.h"

namespace relock::simulator {

/// All that is true of a target on one simulated frame (metrics.md section 1). Means are over the exposure, as the
/// sensor lived through it, rolling shutter and all; the others are at mid-exposure. A mean is one over time: where the target's area in
/// the picture changes during the exposure, its light has another centroid.
struct FlightTruth {
  TargetTruth label;      ///< means: outline, both centres; blur; what is hidden
  bool in_front = false;  ///< before the camera and facing it; else what follows means nothing
  Vec2 outline_middle;    ///< centre of the outline at mid-exposure, px
  Vec2 projected_middle;  ///< image of the physical centre at mid-exposure, px
  double bend_px =
      0;  ///< of the blur: how far the way's middle lies off its chord, to the right of it positive
  double border_px = 0;  ///< from the outline to the picture's nearest border; negative: it is cut
  Eigen::Vector3d translation_m = Eigen::Vector3d::Zero();  ///< of the target in camera coordinates
  Eigen::Vector3d rotation_rad = Eigen::Vector3d::Zero();   ///< target to camera: axis times angle
};

/// Of every target. `steps`: the frame's sub-exposures, so that truth is the mean of just what is rendered.
std::vector<FlightTruth> truth_of_frame(const Scene& scene, const Camera& camera, const Exposure& exposure,
                                        int steps);

}  // namespace relock::simulator
