#pragma once

#include <vector>

#include "detectors/ring/radial_profile.h"

namespace relock::ring {

/// The mean of a marker's light at a point while the marker moves, and how it changes with the point q and with
/// the movement u, in the marker's plane.
struct SweptLight {
  float mean = 0;
  float by_q[2] = {0, 0};
  float by_u[2] = {0, 0};
};

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

  /// At q, moving by u from q - u/2 to q + u/2. |u| must be kShortest or more: a difference of two entries is
  /// divided by it.
  SweptLight at(const float q[2], const float u[2]) const;

  static constexpr float kShortest = 0.12f;
  /// Nothing of the profile lies beyond.
  static constexpr double kEnd = 1.7;

 private:
  struct Entry {
    float sum = 0;     // G
    float along = 0;   // dG/dx = P
    float across = 0;  // dG/dy
    float unused = 0;
  };
  /// dx: G, P, dG/dy at (x, y), x of either sign, y >= 0.
  Entry read(float x, float y) const;

  static constexpr int kSamples = 256;
  static constexpr float kPerRadius = static_cast<float>((kSamples - 1) / kEnd);
  std::vector<Entry> table_;  // a row for each y
};

}  // namespace relock::ring
