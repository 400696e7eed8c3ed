#pragma once

#include <array>
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
    float width() const { return end - begin; }
  };
  /// Where the marker would be whose outermost ring two bars are.
  struct Pair {
    float middle, half;  // steps: midway between its ends, and from there to each
    float foreshortening = 0;
    /// The marker's middle.
    float centre() const { return middle + half * foreshortening; }
    /// Half the length that it would have without foreshortening.
    float scale() const { return half * (1 - foreshortening * foreshortening); }
  };
  /// How a pair looks through a few points.
  struct Glance {
    float contrast, asymmetry;  // grey levels; the mean difference of the two sides over the contrast
  };
  /// Both sides of a pair, from its middle outwards.
  struct Sides {
    std::array<float, kFoldSamples> left, right;
  };

  void find_bars(const Edges& edges);
  bool could_be_one_ring(const Bar& left, const Bar& right, float half) const;
  /// The two bars' pair if it is symmetric, foreshortened as their widths say.
  std::optional<Pair> symmetric_pair(const Line& line, const Bar& left, const Bar& right);
  bool bright_bars_in_the_dark(const Line& line, const Bar& left, const Bar& right) const;
  Glance glance(const Line& line, const Pair& pair);
  /// Whether both bars and a little of the quiet zone are on the line.
  static bool within(const Line& line, const Pair& pair);
  /// The line's values at so many half-lengths from the pair's middle.
  template <std::size_t n>
  void read(const Line& line, const Pair& pair, const std::array<float, n>& at);
  bool folded(const Line& line, const Pair& pair);
  void match(const Line& line, const Pair& pair, const ChordSearch& search, std::vector<Chord>& chords);

  ChordTemplates templates_;
  double least_likeness_;
  float narrowest_, widest_;  // of an outermost bar, parts of the half-length
  float bar_middle_;          // of the outermost ring
  std::size_t bar_sample_;    // of a fold, in the middle of the outermost ring
  EdgeFinder edge_finder_;
  std::vector<Bar> bars_;
  Sides sides_{};
  Fold fold_{};
};

}  // namespace relock::ring
