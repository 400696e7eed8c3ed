#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

namespace relock::simulator {

/// What happens between the light before the lens and the picture's bytes, in this order. Zero turns a part off.
///
/// 1. The lens blurs: a Gaussian whose variance is defocus_px^2 exactly, however small.
/// 2. Light falls off from the middle: to 1 / (1 + k r^2)^2, r the distance from the middle (cos^4 of the angle
///    that the light comes in at). In the middle it is 1, at the pixels in the four corners 1 - vignetting.
/// 3. Gain and noise. If x is the light after that, the signal is y = gain x, with normal noise of variance
///        gain y / full_well_e + (gain read_noise_e / full_well_e)^2
///    for each pixel and channel: the square root of the electrons caught, and the reading. It moves no mean.
/// 4. Clipping to 0 … 1. (In the deepest shadows, this does move the mean.)
/// 5. Display coding; after that sharpening: coded + sharpening (coded - coded blurred by 1 px).
/// 6. Rounding to the nearest byte.
struct SensorPlan {
  double full_well_e = 8000;  ///< electrons at white at gain 1; 0: nothing is counted, and there is no noise
  double read_noise_e = 12;   ///< standard deviation, electrons
  double vignetting = 0.25;   ///< light lost in the corners, share below 1
  double defocus_px = 0.4;    ///< standard deviation of the lens's blur, px, up to 20
  bool srgb = true;           ///< display coding; false: bytes are linear in light
  double sharpening = 0.0;    ///< of a camera's own processing: amount of an unsharp mask of 1 px
};

/// Throws Error naming the part of the plan that is out of range.
void check_sensor(const SensorPlan& plan);

/// Makes bytes of light, with a plan that was checked. `light`: CV_32FC3 in linear light, 1 is white at gain 1,
/// nothing below 0; its contents are used up. `gain` multiplies the light, and so its noise (1: none). `seed` is
/// the frame's own: the same light, plan and seed give the same bytes, on any number of threads. `out`: CV_8UC3,
/// reused where it fits. May be called from several threads; what it needs between is kept for each thread, so
/// that a flight of a thousand frames does not ask for memory a thousand times.
void develop(cv::Mat& light, const SensorPlan& plan, double gain, std::uint64_t seed, cv::Mat& out);

}  // namespace relock::simulator
