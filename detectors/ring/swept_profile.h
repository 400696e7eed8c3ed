#pragma once

#include <vector>

#include "detectors/ring/radial_profile.h"

namespace relock::ring {

/// The mean over long movements, in a time that does not depend on how long they are.
///
/// With x along the movement and y across it, the mean over the movement from x - u/2 to x + u/2 is
///
///     (G(x + u/2, y) - G(x - u/2, y)) / u,     G(x, y) = integral of P(sqrt(s^2 + y^2)) ds from 0 to x,
///
/// where P is the radial profile. G and its two derivatives, of which that along x is P itself, stand in a table
/// for one sigma; between its samples G is continued linearly.
class SweptProfile {
 public:
  SweptProfile(const RadialProfile& profile, double sigma);

  /// At n <= kBlock points (qx, qy), moving by (ux, uy) from q - u/2 to q + u/2. |u| must be kShortest or more: a
  /// difference of two entries is divided by it.
  void mean(const float* qx, const float* qy, const float* ux, const float* uy, int n, SweptLight& out) const;

  static constexpr float kShortest = 0.12f;
  /// Nothing of the profile lies beyond.
  static constexpr double kEnd = 1.7;

 private:
  std::vector<float> table_;  // G, dG/dx, dG/dy and nothing in turn, along x, a row for each y
};

}  // namespace relock::ring
