#include "eval/statistics/interval.h"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>

namespace relock {
namespace {
constexpr double kTail = (1 - kConfidence) / 2;
}

double normal_quantile() {
  static const double z = boost::math::quantile(boost::math::normal(), 1 - kTail);
  return z;
}

double student_quantile(double freedom) {
  return boost::math::quantile(boost::math::students_t(freedom), 1 - kTail);
}

Interval wilson(double successes, double trials) {
  if (!(trials > 0)) return {0, 1};
  const double z2 = normal_quantile() * normal_quantile();
  const double share = successes / trials;
  const double centre = share + z2 / (2 * trials);
  const double half = std::sqrt(z2 * (share * (1 - share) + z2 / (4 * trials)) / trials);
  const double scale = 1 + z2 / trials;
  return {std::max(0.0, (centre - half) / scale), std::min(1.0, (centre + half) / scale)};
}

Interval poisson_rate(std::size_t events, double exposure) {
  if (!(exposure > 0)) return {0, std::numeric_limits<double>::infinity()};
  const auto chi_squared = [](std::size_t freedom, double share) {
    return boost::math::quantile(boost::math::chi_squared(static_cast<double>(freedom)), share);
  };
  const double low = events == 0 ? 0 : chi_squared(2 * events, kTail) / 2;
  return {low / exposure, chi_squared(2 * events + 2, 1 - kTail) / 2 / exposure};
}

}  // namespace relock
