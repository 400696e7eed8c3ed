#pragma once

#include <vector>

#include "detectors/ring/radial_profile.h"

namespace relock::ring {

/// The mean over long movements, in a time that does not depend on how long they are.
///
/// With x along the movement and y across it, a point goes from x + s0 u to x + s1 u, where s = t / (1 + k t) at both ends,
/// and is in ds for a time of dt = (1 + 2 k s) ds, but for the squares of k. So the mean over the exposure is
///
///     (1 - 2 k x / u) (G(x1, y) - G(x0, y)) / u + 2 k (W(r1) - W(r0)) / u^2
///
///     G(x, y) = integral of P(sqrt(s^2 + y^2)) ds from 0 to x,     W(r) = integral of P(s) s ds from 0 to r,
///
/// where P is the radial profile and r1, r0 are the distances of both ends from the middle. G and its two derivatives, of
/// which that along x is P itself, stand in a table for one sigma, and so does W; between its samples G is continued
/// linearly.
class SweptProfile {
 public:
  SweptProfile(const RadialProfile& profile, double sigma);

  /// At n <= kBlock points. |u| must be kShortest or more: a difference of two entries is divided by it. The
  /// gradients leave out what the two terms with k change, which is little.
  void mean(const Movements& moved, int n, SweptLight& out) const;

  static constexpr float kShortest = 0.12f;
  /// Nothing of the profile lies beyond.
  static constexpr double kEnd = 1.7;

 private:
  std::vector<float> moment_;  // W, along the radius
  std::vector<float> table_;   // G, dG/dx, dG/dy and nothing in turn, along x, a row for each y
};

}  // namespace relock::ring
