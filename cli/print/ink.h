#pragma once

#include <cmath>

namespace relock {

/// The grey, in [0, 1], that displays and printers show as this part of white's light (sRGB, IEC 61966-2-1).
inline double grey_of_light(double light) {
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}

}  // namespace relock
