#pragma once

#include <cmath>

#include "core/geometry.h"

namespace relock::particles {

/// Where a particle puts the target: a similarity and an aspect, relative to the start box. (Six affine numbers
/// are what l1's published code has; a shear is a thing that few targets do and that fits much of what is none.)
struct State {
  Vec2 centre = {};         ///< px
  double scale = 1;         ///< of the start box's width
  double aspect = 1;        ///< height over width, relative to the start box
  double rotation_rad = 0;  ///< from +x towards +y
};

/// A vector of the start picture, from the start box's centre, as it is seen at `state`; px.
inline Vec2 carried(const State& state, Vec2 v) {
  const double x = state.scale * v.x, y = state.scale * state.aspect * v.y;
  const double c = std::cos(state.rotation_rad), s = std::sin(state.rotation_rad);
  return {c * x - s * y, s * x + c * y};
}

/// The upright box of the target's size about its centre, `start` being the start box's width and height. It is not
/// turned: labels and scores are of upright boxes, and one around a turned box grows with every error of the angle.
inline Box unturned_box(const State& state, Vec2 start) {
  const double width = state.scale * start.x, height = state.scale * state.aspect * start.y;
  return {state.centre.x - width / 2, state.centre.y - height / 2, width, height};
}

}  // namespace relock::particles
