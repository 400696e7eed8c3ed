#pragma once
#include <vector>
#include "core/geometry.h"
namespace relock::ring {
struct Chord {
  Vec2 middle; Vec2 along; double radius_px = 0; std::size_t code = 0; double blur = 0; double misalignment_rad = 0; double likeness = 0; int direction = 0;
};
struct Candidate { Chord best; std::vector<Chord> chords; double score = 0; int directions = 0; };
}
