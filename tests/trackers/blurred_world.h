#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "core/sighting.h"

namespace relock {

/// A target of 80 x 72 px on a wall, 480 x 320 px, grey, seen by a camera that moves while it exposes: all of the
/// picture is blurred, straight and evenly.
struct BlurredWorld {
  explicit BlurredWorld(std::uint64_t seed);

  /// The target's middle is `centre`, a part of a pixel included, in the middle of the exposure.
  cv::Mat1b picture(Vec2 centre, const BlurEstimate& blur = {}) const;
  static Box box(Vec2 centre);
  static constexpr Vec2 kMiddle{239.5, 159.5};
  static constexpr double kWidth = 80, kHeight = 72;

 private:
  cv::Mat1f wall_;  // larger than the picture by its reach on every side, the target on its middle
};

/// Where the target is, and the blur it has, frame by frame at 30 Hz without gaps: velocities turn within some frames
/// and grow to `fastest` px a frame; the shutter is open for 5/6 of a frame's period (kappa 1.2).
struct BlurredPath {
  std::vector<Vec2> centres;
  std::vector<BlurEstimate> blurs;
};
BlurredPath blurred_path(int frames, double fastest, std::uint64_t seed);

}  // namespace relock
