#pragma once

#include <cstdint>

namespace relock {

/// The generator behind everything drawn at random: SplitMix64 (Steele, Lea and Flood 2014). Its own, because
/// the distributions of the standard library differ from build to build. Same seed, same numbers, everywhere.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t next();
  /// Uniform in [0, 1), 53 bits.
  double uniform();
  /// True with probability p.
  bool chance(double p) { return uniform() < p; }
  /// Uniform in {0, …, n - 1}; n > 0.
  std::uint64_t below(std::uint64_t n);
  /// An independent generator for the purpose `key`.
  Random fork(std::uint64_t key) const;

 private:
  std::uint64_t state_;
};

}  // namespace relock
