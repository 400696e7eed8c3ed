#pragma once

#include <array>
#include <cstdint>

#include "core/random.h"

namespace relock::simulator {

/// One standard normal number for each value of 16 bits: the middles of 65536 equally likely parts, in order.
/// Mean 0 and variance 1 to rounding; the largest is 4.3, which happens once in 65536 draws.
using NormalTable = std::array<float, 65536>;
const NormalTable& normal_table();

/// Standard normal numbers, four for each number drawn at random. A table, because a picture needs one for each
/// byte: what transforms uniform numbers takes longer than all the rest of a sensor.
class Noise {
 public:
  explicit Noise(const Random& random) : random_(random) {}

  std::array<float, 4> next() {
    const std::uint64_t bits = random_.next();
    return {table_[bits & 0xffff], table_[bits >> 16 & 0xffff], table_[bits >> 32 & 0xffff],
            table_[bits >> 48]};
  }

 private:
  Random random_;
  const NormalTable& table_ = normal_table();
};

}  // namespace relock::simulator
