#include "sequences/simulator/sensor_noise.h"

#include <cmath>
#include <numbers>

namespace relock::simulator {
namespace {

constexpr std::size_t kHalf = NormalTable{}.size() / 2;

/// The number that a standard normal one is below with probability `p`, by Newton's method from a close `guess`.
double quantile(double p, double guess) {
  for (int step = 0; step < 6; ++step) {
    const double above = std::erfc(guess / std::numbers::sqrt2) / 2;
    const double density = std::exp(-guess * guess / 2) / std::sqrt(2 * std::numbers::pi);
    guess += (above - (1 - p)) / density;
  }
  return guess;
}

NormalTable make_table() {
  std::array<double, kHalf> upper{};
  double guess = 0, squares = 0;
  for (std::size_t i = 0; i < kHalf; ++i) {
    guess = quantile(0.5 + (static_cast<double>(i) + 0.5) / (2 * kHalf), guess);
    upper[i] = guess;
    squares += guess * guess;
  }
  // The middle of a part is a little nearer to 0 than what is drawn from all of it.
  const double scale = std::sqrt(kHalf / squares);
  NormalTable table{};
  for (std::size_t i = 0; i < kHalf; ++i) {
    table[kHalf + i] = static_cast<float>(scale * upper[i]);
    table[kHalf - 1 - i] = -table[kHalf + i];
  }
  return table;
}

}  // namespace

const NormalTable& normal_table() {
  static const NormalTable table = make_table();
  return table;
}

}  // namespace relock::simulator
