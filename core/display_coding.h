#pragma once

#include <cmath>

namespace relock {

// Between light and what displays and printers are told of it (sRGB, IEC 61966-2-1), both in [0, 1].

inline double light_of_coded(double coded) {
  return coded <= 0.04045 ? coded / 12.92 : std::pow((coded + 0.055) / 1.055, 2.4);
}
inline double coded_of_light(double light) {
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}

}  // namespace relock
