#pragma once

#include <cstddef>

namespace relock {

/// Share of the times that an interval holds the true value, when experiment and interval are repeated.
constexpr double kConfidence = 0.95;

/// A confidence interval, of the unit of what it is about. docs/statistics.md says which kind stands where.
struct Interval {
  double low = 0, high = 0;
  friend bool operator==(const Interval&, const Interval&) = default;
};

/// Of the probability of success in independent trials (Wilson 1927). Only where the trials are independent:
/// frames in a row are not. [0, 1] without a trial.
Interval wilson(double successes, double trials);

/// Of the rate of independent events, per unit of exposure: exact, from quantiles of chi-squared (Garwood
/// 1936). Without exposure nothing is known: [0, infinity].
Interval poisson_rate(std::size_t events, double exposure);

/// The quantile that leaves (1 - kConfidence) / 2 above it: of the normal distribution, and of Student's t
/// with `freedom` > 0 degrees of freedom, which need not be whole.
double normal_quantile();
double student_quantile(double freedom);

}  // namespace relock
