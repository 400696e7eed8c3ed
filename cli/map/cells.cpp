#include "cli/map/cells.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace relock::maps {
namespace {

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

double mean_share(const MethodMap& method) {
  double total = 0, cells = 0;
  for (const auto& row : method.cells)
    for (const LockedTime& cell : row)
      if (const auto share = locked_share(cell).value) total += *share, cells += 1;
  return cells > 0 ? total / cells : 0;
}

/// What two estimates make together, of their values and of every seed's departures.
template <class Make>
Estimate combined(const Estimate& a, const Estimate& b, const Make& make) {
  const auto of = [&](const std::optional<double>& x, const std::optional<double>& y) {
    return x && y ? std::optional<double>(make(*x, *y)) : std::nullopt;
  };
  Estimate result{of(a.value, b.value), {}};
  for (std::size_t seed = 0; seed < a.departures.size(); ++seed)
    result.departures.push_back(of(a.departures[seed], b.departures[seed]));
  return result;
}

}  // namespace

Interval Estimate::interval() const {
  constexpr double kUnknown = std::numeric_limits<double>::infinity();
  double squares = 0, n = 0;
  for (const auto& departure : departures)
    if (departure) squares += *departure * *departure, n += 1;
  if (!value || n < 2) return {-kUnknown, kUnknown};
  const double half = student_quantile(n - 1) * std::sqrt(squares / (n * (n - 1)));
  return {*value - half, *value + half};
}

Estimate locked_share(const LockedTime& time) {
  const double visible = sum(time.visible_s);
  Estimate share{{}, std::vector<std::optional<double>>(time.visible_s.size())};
  if (!(visible > 0)) return share;
  share.value = sum(time.locked_s) / visible;
  const auto votes =
      std::count_if(time.visible_s.begin(), time.visible_s.end(), [](double s) { return s > 0; });
  const double mean_visible = visible / static_cast<double>(votes);
  for (std::size_t seed = 0; seed < time.visible_s.size(); ++seed)
    if (time.visible_s[seed] > 0)
      share.departures[seed] = (time.locked_s[seed] - *share.value * time.visible_s[seed]) / mean_visible;
  return share;
}

Estimate difference(const Estimate& a, const Estimate& b) {
  return combined(a, b, [](double x, double y) { return x - y; });
}

Estimate between(const Estimate& a, const Estimate& b, double part) {
  return combined(a, b, [&](double x, double y) { return std::lerp(x, y, part); });
}

const char* to_string(MethodClass kind) {
  switch (kind) {
    case MethodClass::tracker:
      return "tracker";
    case MethodClass::detector:
      return "detector";
    case MethodClass::yardstick:
      break;
  }
  return "yardstick";
}

Ahead ahead(const Estimate& difference) {
  const Interval interval = difference.interval();
  return interval.low > 0 ? Ahead::tracking : interval.high < 0 ? Ahead::detection : Ahead::undecided;
}

const MethodMap* best_of(const std::vector<MethodMap>& methods, MethodClass kind) {
  const MethodMap* best = nullptr;
  for (const MethodMap& method : methods)
    if (method.kind == kind && (!best || mean_share(method) > mean_share(*best))) best = &method;
  return best;
}

Grid<Estimate> differences(const MethodMap& tracking, const MethodMap& detection) {
  Grid<Estimate> all(tracking.cells.size());
  for (std::size_t row = 0; row < all.size(); ++row)
    for (std::size_t column = 0; column < tracking.cells[row].size(); ++column)
      all[row].push_back(
          difference(locked_share(tracking.cells[row][column]), locked_share(detection.cells[row][column])));
  return all;
}

}  // namespace relock::maps
