#pragma once

#include <vector>

#include "core/geometry.h"

namespace relock {

/// An outline as numbers that change smoothly while a target moves, each with what an error of 1 px makes of it.
struct OutlineNumbers {
  Vec2 middle;                ///< px: of a box or an ellipse its centre, of a quad the mean of its corners
  std::vector<double> shape;  ///< logarithms of sizes; an angle in rad; a quad's corners as parts of its size
  std::vector<double> shape_per_px;  ///< how far each is off when what was placed is off by 1 px
};

OutlineNumbers numbers_of(const Outline& outline);
/// An ellipse's angle comes only up to half a turn: makes it the one that is nearest to that of `before`.
void follow(OutlineNumbers& numbers, const OutlineNumbers& before, const Outline& of);
/// The outline of the kind of `like` that has these numbers.
Outline outline_of(const OutlineNumbers& numbers, const Outline& like);

}  // namespace relock
