#pragma once

namespace relock::maps {

struct Colour {
  double red = 0, green = 0, blue = 0;  ///< in [0, 1], sRGB

  /// Of grey that looks as light, sRGB coded.
  double lightness() const;
};

/// Of a share in [0, 1]: viridis (van der Walt and Smith 2015), dark to light, even to the eye and to all kinds
/// of colour vision.
Colour share_colour(double share);

/// Of a difference in [-1, 1]: ColorBrewer's PuOr (Harrower and Brewer 2003), orange over white to purple, told
/// apart by all kinds of colour vision.
Colour difference_colour(double difference);

/// Black or white, whichever is easier to read on it.
Colour ink_on(const Colour& ground);

}  // namespace relock::maps
