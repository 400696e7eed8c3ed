#include "cli/map/boundary.h"

#include <algorithm>

namespace relock::maps {
namespace {

constexpr int kStepsPerCell = 64;  // at which the interpolated differences are looked at

std::vector<double> negated(std::vector<double> values) {
  for (double& value : values) value = -value;
  return values;
}

double squared_distance(std::span<const double> a, std::span<const double> b) {
  double total = 0;
  for (std::size_t i = 0; i < a.size(); ++i) total += (a[i] - b[i]) * (a[i] - b[i]);
  return total;
}

/// Rising or falling, whichever is nearer.
std::vector<double> monotone(const std::vector<double>& values) {
  std::vector<double> rising = isotonic(values);
  std::vector<double> falling = negated(isotonic(negated(values)));
  return squared_distance(falling, values) <= squared_distance(rising, values) ? falling : rising;
}

/// Between the last cell of one sign and the first of the other; a run of zeros between them is halved.
std::optional<double> crossing(std::span<const double> axis, const std::vector<double>& fit) {
  const bool first_positive = fit.front() > 0;
  if (fit.front() == 0 || fit.back() == 0 || first_positive == (fit.back() > 0)) return {};
  std::size_t last = 0, next = fit.size() - 1;
  while (fit[last + 1] != 0 && (fit[last + 1] > 0) == first_positive) ++last;
  while (fit[next - 1] != 0 && (fit[next - 1] > 0) != first_positive) --next;
  if (next > last + 1) return (axis[last + 1] + axis[next - 1]) / 2;
  return axis[last] + (axis[next] - axis[last]) * fit[last] / (fit[last] - fit[next]);
}

/// From the cell `decided`, at which `side` is ahead beyond doubt, towards its neighbour: how far that holds,
/// but not past `at`.
double last_decided(std::span<const double> axis, std::span<const Estimate> differences, std::size_t decided,
                    std::size_t neighbour, Ahead side, double at) {
  double place = axis[decided];
  for (int step = 1; step <= kStepsPerCell; ++step) {
    const double part = static_cast<double>(step) / kStepsPerCell;
    const double next = axis[decided] + (axis[neighbour] - axis[decided]) * part;
    const bool past = neighbour > decided ? next > at : next < at;
    if (past || ahead(between(differences[decided], differences[neighbour], part)) != side) break;
    place = next;
  }
  return place;
}

Ahead other(Ahead side) { return side == Ahead::tracking ? Ahead::detection : Ahead::tracking; }

}  // namespace

std::vector<double> isotonic(std::span<const double> values) {
  struct Block {
    double total, count;
    double mean() const { return total / count; }
  };
  std::vector<Block> blocks;
  for (const double value : values) {
    blocks.push_back({value, 1});
    while (blocks.size() > 1 && blocks[blocks.size() - 2].mean() > blocks.back().mean()) {
      const Block last = blocks.back();
      blocks.pop_back();
      blocks.back().total += last.total, blocks.back().count += last.count;
    }
  }
  std::vector<double> fit;
  for (const Block& block : blocks)
    fit.insert(fit.end(), static_cast<std::size_t>(block.count), block.mean());
  return fit;
}

std::optional<Boundary> boundary_of(std::span<const double> whole_axis,
                                    std::span<const Estimate> all_differences) {
  std::vector<double> axis, values;
  std::vector<Estimate> differences;
  for (std::size_t i = 0; i < whole_axis.size(); ++i) {
    if (!all_differences[i].value) continue;
    axis.push_back(whole_axis[i]);
    values.push_back(*all_differences[i].value);
    differences.push_back(all_differences[i]);
  }
  if (axis.size() < 2) return {};
  const std::vector<double> fit = monotone(values);
  const auto at = crossing(axis, fit);
  if (!at) return {};
  Boundary boundary{*at, {}, {}, fit.front() > 0 ? Ahead::tracking : Ahead::detection};
  const Ahead before = boundary.before, after = other(before);
  for (std::size_t cell = 0; cell < axis.size(); ++cell) {
    const Ahead winner = ahead(differences[cell]);
    if (axis[cell] <= *at && winner == before && cell + 1 < axis.size())
      boundary.low = last_decided(axis, differences, cell, cell + 1, before, *at);
    if (axis[cell] >= *at && winner == after && cell > 0 && !boundary.high)
      boundary.high = last_decided(axis, differences, cell, cell - 1, after, *at);
  }
  if (!boundary.low && !boundary.high) return {};
  return boundary;
}

}  // namespace relock::maps
