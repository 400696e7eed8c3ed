#pragma once

#include <cstddef>
#include <vector>

#include "core/geometry.h"

namespace relock::ring {

/// A line across the picture along which a marker's pattern shows: bars that are symmetric about `middle`.
struct Chord {
  Vec2 middle;           ///< px of the full picture
  Vec2 along;            ///< unit vector
  double radius_px = 0;  ///< of the outermost ring along it
  std::size_t code = 0;  ///< rank, in the order of all_ring_bits, of the code whose profile it matches best
  double blur = 0;       ///< length of the blur over the radius, of that profile
  double misalignment_rad = 0;  ///< between the line and the perpendicular of the blur, of that profile
  double likeness = 0;          ///< normalised correlation with that profile, to 1
  int direction = 0;            ///< which of kLineDirections
};

/// Chords that agree on where a marker is.
struct Candidate {
  Chord best;                 ///< of the most convincing radius, the chord most like a marker
  std::vector<Chord> chords;  ///< those that agree, the most like a marker first
  double score = 0;           ///< candidates are ordered by it; comparable within one picture only
  int directions = 0;         ///< how many of kLineDirections have a chord with the code of the best
};

/// What chords agree on. Memory is kept from picture to picture.
class CandidateGrouper {
 public:
  /// Best first; valid until the next call. `chords` are sorted.
  const std::vector<Candidate>& group(std::vector<Chord>& chords);

 private:
  Candidate& fresh(const Chord& best);
  /// Ranks it, and appends what it is if another radius is the marker's: the convincing one may be an inner ring, or
  /// clutter.
  void rank(std::size_t candidate);

  std::vector<Candidate> candidates_, spare_;
};

}  // namespace relock::ring
