#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace relock {

/// One quantity as it was read at some times, each with the standard deviation of the reading.
struct Readings {
  std::vector<double> at_s;  ///< strictly rising
  std::vector<double> value;
  std::vector<double> sigma;  ///< above 0
};

/// How a quantity changes with time, as far as one knows before it is read.
struct CurveModel {
  int order = 2;            ///< which derivative does a random walk, but one: 2 velocity, 3 acceleration
  double restlessness = 1;  ///< variance of that walk per second
  /// Standard deviation of what is quicker than the readings can follow: the quantity trembles so much about the curve.
  double tremor = 0;
};

/// A smooth curve through readings: the cubic B-spline f that makes
///
///     sum of rho((f(t) - value) / s)  +  1/restlessness * integral of (order-th derivative of f)^2 dt
///
/// least, where s^2 = sigma^2 + tremor^2 and rho is Huber's loss at 3. So a straight line is followed exactly, a bend as
/// far as the readings want it, and a single slip of the hand costs little. That is also the posterior of a quantity
/// that changes as CurveModel has it, which is where its uncertainty comes from: small at readings, growing with the
/// 3/2th (order 3: 5/2th) power of the time between them.
class SmoothCurve {
 public:
  /// At least two readings.
  SmoothCurve(const Readings& readings, const CurveModel& model);
  ~SmoothCurve();
  SmoothCurve(SmoothCurve&&) noexcept;

  /// Between the first and the last reading.
  double value(double at_s) const;
  /// Standard deviation of the quantity itself there, tremor included; not of a new reading.
  double sigma(double at_s) const;

 private:
  struct Fit;
  std::unique_ptr<const Fit> fit_;
};

/// A reading against the curve through all others.
struct LeftOut {
  double error = 0;  ///< reading - curve
  double sigma = 0;  ///< standard deviation that the curve states for it, that of the reading included
};
/// For each reading; nothing where the others do not tell (fewer than two are left). The loss is plain squares here.
std::vector<std::optional<LeftOut>> leave_each_out(const Readings& readings, const CurveModel& model);

/// Which models are tried.
enum class Models : std::uint8_t {
  steady,  ///< order 2 without tremor
  all,     ///< orders 2 and 3, with and without tremor
};
/// The model that foretells left-out readings best (their likelihood), common to all of `tracks`, and rather too restless
/// than too sure: the more readings, the less so. Where they are too few to tell, order 2 with a restlessness near `usual`, in the readings' unit squared per second cubed.
CurveModel likely_model(std::span<const Readings> tracks, double usual, Models models);

}  // namespace relock
