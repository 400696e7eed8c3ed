#include "cli/map/colours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace relock::maps {
namespace {

constexpr Colour hex(unsigned code) {
  return {(code >> 16 & 0xff) / 255.0, (code >> 8 & 0xff) / 255.0, (code & 0xff) / 255.0};
}

constexpr std::array kViridis{hex(0x440154), hex(0x482878), hex(0x3e4989), hex(0x31688e), hex(0x26828e),
                              hex(0x1f9e89), hex(0x35b779), hex(0x6ece58), hex(0xb5de2b), hex(0xfde725)};
constexpr std::array kOrangeToPurple{hex(0xb35806), hex(0xe08214), hex(0xfdb863),
                                     hex(0xfee0b6), hex(0xf7f7f7), hex(0xd8daeb),
                                     hex(0xb2abd2), hex(0x8073ac), hex(0x542788)};

Colour along(std::span<const Colour> ramp, double place) {
  const double at = std::clamp(place, 0.0, 1.0) * static_cast<double>(ramp.size() - 1);
  const auto first = std::min(static_cast<std::size_t>(at), ramp.size() - 2);
  const double part = at - static_cast<double>(first);
  const Colour &a = ramp[first], &b = ramp[first + 1];
  return {std::lerp(a.red, b.red, part), std::lerp(a.green, b.green, part), std::lerp(a.blue, b.blue, part)};
}

}  // namespace

double Colour::lightness() const { return 0.2126 * red + 0.7152 * green + 0.0722 * blue; }

Colour share_colour(double share) { return along(kViridis, share); }

Colour difference_colour(double difference) { return along(kOrangeToPurple, (difference + 1) / 2); }

Colour ink_on(const Colour& ground) { return ground.lightness() > 0.5 ? Colour{0, 0, 0} : Colour{1, 1, 1}; }

}  // namespace relock::maps
