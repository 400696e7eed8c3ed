#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "detectors/ring_marker.h"

namespace relock::ring {

// Lengths are parts of the outermost ring's radius R.

/// How a line through a marker's middle looks while the marker moves.
struct Exposed {
  double blur = 0;              ///< length of the movement
  double misalignment_rad = 0;  ///< between the line and the perpendicular of the movement
  double softness = 0.03;       ///< standard deviation of the lens's and the pixels' blur
};

/// Along such a line, every kGrid of R from the middle outwards, the light of a ring from radius `ring.inner` to
/// `ring.outer` on black: averaged exactly over the movement, and over the softness along the line.
inline constexpr double kGrid = 0.004;
std::vector<double> exposed_ring(const Annulus& ring, const Exposed& exposed);

/// Grey values along half a line from its middle to kReach times the half-length of the outermost bars: the mean
/// of both halves.
inline constexpr std::size_t kFoldSamples = 32;
/// Far enough into the quiet zone: else the inner rings of a marker look like a smaller marker.
inline constexpr double kReach = 1.21;
using Fold = std::array<float, kFoldSamples>;

/// What the folds of a marker's chords look like: every code, blurs, misalignments and softnesses.
class ChordTemplates {
 public:
  struct Shape {
    std::size_t code = 0;  ///< rank in the order of all_ring_bits
    Exposed exposed;
    double edge = 1;  ///< where the outermost bar's outer edge is steepest: blur moves it inwards
  };
  struct Match {
    std::size_t shape = 0;
    float likeness = -1;  ///< normalised correlation, to 1
  };

  /// For blurs up to `most_blur` R.
  ChordTemplates(const RingGeometry& geometry, double most_blur);

  std::size_t size() const { return shapes_.size(); }
  const Shape& shape(std::size_t rank) const { return shapes_[rank]; }
  /// The fold of a template: mean 0, square sum 1.
  Fold fold(std::size_t rank) const;
  /// The template most like a fold whose mean is 0 and whose square sum is 1.
  Match best(const Fold& fold) const;

 private:
  void add(std::size_t code, const Exposed& exposed, const std::vector<double>& profile);
  void lay_out();

  double first_edge_ = 0;  // no outer edge is farther in
  std::vector<Shape> shapes_;
  std::vector<Fold> folds_;
  std::size_t stride_ = 0;
  std::vector<float> columns_;  // sample by sample, the templates' values, stride_ apart
};

}  // namespace relock::ring
