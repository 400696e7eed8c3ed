#pragma once

#include <vector>

#include "detectors/ring_marker.h"

// What a marker looks like along a radius, through a lens. Lengths are parts of the outermost ring's radius.

namespace relock::ring {

/// So many points are worked on together: loops over them become vector instructions.
constexpr int kBlock = 64;
using Row = float[kBlock];

/// How some points of the marker's plane move over the exposure, from t = -1/2 to 1/2, when the picture moves evenly:
///
///     q(t) = q + u t / (1 + k t)
///
/// on a straight line, and the slower the farther they get away: k is by what part of itself the depth changes.
struct Movements {
  const float *qx, *qy, *ux, *uy, *k;
};

/// The mean of a marker's light at some points while the marker moves, and how it changes with each point q and
/// its movement u, in the marker's plane.
struct SweptLight {
  alignas(32) Row mean, by_qx, by_qy, by_ux, by_uy;
};

/// The light of some annuli about one middle, 1 in them and 0 outside, smoothed by a Gaussian: against the
/// radius, for any width of the Gaussian that matters. An edge is smoothed as if it were straight, which is
/// right to the second order of sigma over its radius.
class RadialProfile {
 public:
  explicit RadialProfile(const std::vector<Annulus>& annuli);

  /// Beyond this radius the tables have no light. It is well beyond any edge that they are made for.
  static constexpr double kEnd = 2.4;
  static constexpr double kLeastSigma = 0.004, kSigmaRatio = 1.2;
  static constexpr int kSigmas = 24;

  /// At n <= kBlock points, smoothed by Gaussians of these variances, while they move: the mean over the middles of
  /// `moments` equal parts of the time, each smoothed by its own length, so that few are enough for short movements.
  /// With the nearest sigma that there is, linearly between radii.
  void mean(const Movements& moved, const float* variance, int n, int moments, SweptLight& out) const;

  /// The value at a radius, and its slope, without tables.
  double value(double radius, double sigma) const;
  double slope(double radius, double sigma) const;

 private:
  std::vector<Annulus> annuli_;
  std::vector<float> table_;  // value and slope in turn, along the radius, a row for each sigma
};

}  // namespace relock::ring
