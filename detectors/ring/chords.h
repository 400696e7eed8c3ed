#pragma once

#include <cstddef>
#include <vector>

#include "detectors/ring/candidates.h"
#include "detectors/ring/chord_templates.h"
#include "detectors/ring/line_scan.h"
#include "detectors/ring_marker.h"

namespace relock::ring {

/// How the lines of one direction on one level of the pyramid are searched.
struct ChordSearch {
  int direction = 0;           ///< of kLineDirections
  std::size_t level = 0;       ///< of the pyramid that the lines cross
  int least_rise = 11;         ///< of an edge, grey levels over two steps
  double least_radius_px = 9;  ///< px of that level
  double most_radius_px = 100;
};

/// Finds chords of markers along lines: every two bright bars that could be the outermost ring on both sides of a
/// marker, checked by what lies between and around them. Tests go from cheap to dear; each is necessary.
class ChordFinder {
 public:
  ChordFinder(const RingGeometry& geometry, double most_blur, double least_likeness);

  /// Appends the chords along all lines of `scan` to `chords`.
  void find(const LineScan& scan, const ChordSearch& search, std::vector<Chord>& chords);

 private:
  /// A bright stretch of a line: between an edge that rises and one that falls.
  struct Bar {
    float begin, end;  // steps
    float rise, fall;  // grey levels over two steps, both positive
  };
  /// What the middle and half-length of two bars would be.
  struct Pair {
    float middle, half;  // steps
  };

  void find_bars(const Edges& edges);
  bool could_be_one_ring(const Bar& left, const Bar& right, float half) const;
  static bool symmetric_at_a_glance(const Line& line, const Pair& pair);
  bool folded(const Line& line, const Pair& pair);
  void match(const Line& line, const Pair& pair, const ChordSearch& search, std::vector<Chord>& chords);

  ChordTemplates templates_;
  double least_likeness_;
  float narrowest_, widest_;  // of an outermost bar, parts of the half-length
  std::size_t bar_sample_;    // of a fold, in the middle of the outermost ring
  EdgeFinder edge_finder_;
  std::vector<Bar> bars_;
  Fold fold_{};
};

}  // namespace relock::ring
