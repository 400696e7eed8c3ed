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
    for (const LockedTime& cell : row) total += locked_share(cell).value, cells += 1;
  return cells > 0 ? total / cells : 0;
}

}  // namespace

Interval Estimate::interval() const {
  constexpr double kUnknown = std::numeric_limits<double>::infinity();
  if (departures.size() < 2) return {-kUnknown, kUnknown};
  double squares = 0;
  for (const double departure : departures) squares += departure * departure;
  const double n = static_cast<double>(departures.size());
  const double half = student_quantile(n - 1) * std::sqrt(squares / (n * (n - 1)));
  return {value - half, value + half};
}

Estimate locked_share(const LockedTime& time) {
  const double visible = sum(time.visible_s);
  Estimate share{visible > 0 ? sum(time.locked_s) / visible : 0, {}};
  const double mean_visible = visible / static_cast<double>(time.visible_s.size());
  for (std::size_t seed = 0; seed < time.visible_s.size(); ++seed)
    share.departures.push_back(
        visible > 0 ? (time.locked_s[seed] - share.value * time.visible_s[seed]) / mean_visible : 0);
  return share;
}

Estimate difference(const Estimate& a, const Estimate& b) {
  Estimate result{a.value - b.value, {}};
  for (std::size_t seed = 0; seed < a.departures.size(); ++seed)
    result.departures.push_back(a.departures[seed] - b.departures[seed]);
  return result;
}

Estimate between(const Estimate& a, const Estimate& b, double part) {
  Estimate result{std::lerp(a.value, b.value, part), {}};
  for (std::size_t seed = 0; seed < a.departures.size(); ++seed)
    result.departures.push_back(std::lerp(a.departures[seed], b.departures[seed], part));
  return result;
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
