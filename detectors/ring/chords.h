#pragma once

#include <cstddef>
#include <optional>
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
  /// Where the marker would be whose outermost ring two bars are.
  struct Pair {
    float middle, half;  // steps: midway between its ends, and from there to each
    float foreshortening = 0;

    /// A point `u` half-lengths from the marker's middle, as the line shows it, steps.
    float at(float u) const {
      return middle +
             half * (foreshortening + (1 - foreshortening * foreshortening) * u / (1 + foreshortening * u));
    }
  };
  /// How a pair looks through a few points.
  struct Glance {
    float contrast, asymmetry;  // grey levels; the mean difference of the two sides over the contrast
    bool promising() const;
  };

  void find_bars(const Edges& edges);
  bool could_be_one_ring(const Bar& left, const Bar& right, float half) const;
  /// The two bars' pair if it is symmetric, foreshortened as their widths say.
  std::optional<Pair> symmetric_pair(const Line& line, const Bar& left, const Bar& right) const;
  static Glance glance(const Line& line, const Pair& pair);
  bool folded(const Line& line, const Pair& pair);
  void match(const Line& line, const Pair& pair, const ChordSearch& search, std::vector<Chord>& chords);

  ChordTemplates templates_;
  double least_likeness_;
  float narrowest_, widest_;  // of an outermost bar, parts of the half-length
  float bar_middle_;          // of the outermost ring
  std::size_t bar_sample_;    // of a fold, in the middle of the outermost ring
  EdgeFinder edge_finder_;
  std::vector<Bar> bars_;
  Fold fold_{};
};

}  // namespace relock::ring
