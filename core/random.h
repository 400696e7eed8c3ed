#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace relock {

/// The generator behind everything drawn at random: SplitMix64 (Steele, Lea and Flood 2014). Its own, because
/// the distributions of the standard library differ from build to build. Same seed, same numbers, everywhere.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t next() {
    state_ += kGolden;
    return mix(state_);
  }
  /// Uniform in [0, 1), 53 bits.
  double uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }
  /// Standard normal (Box and Muller 1958): of two uniform numbers.
  double normal() {
    const double radius = std::sqrt(-2 * std::log(1 - uniform()));
    return radius * std::cos(2 * std::numbers::pi * uniform());
  }
  /// True with probability p.
  bool chance(double p) { return uniform() < p; }
  /// Uniform in {0, …, n - 1}; n > 0.
  std::uint64_t below(std::uint64_t n) {
    // Draws above the largest multiple of n are thrown away, so that no remainder is favoured.
    const std::uint64_t spare = (0 - n) % n;
    std::uint64_t drawn = next();
    while (drawn < spare) drawn = next();
    return drawn % n;
  }
  /// An independent generator for the purpose `key`.
  Random fork(std::uint64_t key) const { return Random(mix(state_ ^ mix(key + kGolden))); }

 private:
  static constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15u;

  static std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

  std::uint64_t state_;
};

}  // namespace relock
