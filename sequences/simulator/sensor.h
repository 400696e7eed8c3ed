#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

namespace relock::simulator {

/// What happens between the light on the sensor and the picture's bytes. Zero turns a part off.
struct SensorPlan {
  double full_well_e = 8000;  ///< electrons at white at gain 1; shot noise is their square root; 0: none
  double read_noise_e = 12;   ///< standard deviation, electrons
  double vignetting = 0.25;   ///< light lost in the corners, share
  double defocus_px = 0.4;    ///< standard deviation of the lens's blur, px
  bool srgb = true;           ///< display coding; false: bytes are linear in light
  double sharpening = 0.0;    ///< of a camera's own processing: amount of an unsharp mask of 1 px
};

/// Makes bytes of light. `light`: CV_32FC3 in linear light, 1 is white at gain 1; its contents are used up.
/// `gain` multiplies the light, and so its noise (1: none). `seed` is the frame's own: the same light, plan
/// and seed give the same bytes. `out`: CV_8UC3, reused where it fits.
void develop(cv::Mat& light, const SensorPlan& plan, double gain, std::uint64_t seed, cv::Mat& out);

}  // namespace relock::simulator
