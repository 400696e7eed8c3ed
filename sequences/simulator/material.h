#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "sequences/simulator/painting.h"

namespace relock::simulator {

enum class Material : std::uint8_t { plaster, wallpaper, brick, concrete, wood, tiles, cardboard };

/// What a wall, floor or box is made of.
struct Finish {
  Material material = Material::plaster;
  std::uint64_t seed = 0;
  cv::Scalar colour;     ///< coded blue, green, red as of paint(): of most of it
  bool upright = false;  ///< wood: boards run down, not across
};

/// Paints the whole canvas with it.
void cover(Canvas& canvas, const Finish& finish);

}  // namespace relock::simulator
