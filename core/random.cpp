#include "core/random.h"

namespace relock {
namespace {

std::uint64_t mix(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15u;

}  // namespace

std::uint64_t Random::next() {
  state_ += kGolden;
  return mix(state_);
}

double Random::uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }

std::uint64_t Random::below(std::uint64_t n) {
  // Draws above the largest multiple of n are thrown away, so that no remainder is favoured.
  const std::uint64_t spare = (0 - n) % n;
  std::uint64_t drawn = next();
  while (drawn < spare) drawn = next();
  return drawn % n;
}

Random Random::fork(std::uint64_t key) const { return Random(mix(state_ ^ mix(key + kGolden))); }

}  // namespace relock
