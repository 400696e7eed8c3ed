#include "sequences/vot_region.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/error.h"
#include "core/outline_csv.h"
#include "sequences/benchmark.h"

namespace relock {
namespace {

constexpr Vec2 kHalfPixel{0.5, 0.5};
constexpr std::int64_t kLargestMask_px = 100'000;

/// Whole numbers between commas.
std::vector<std::int64_t> whole_numbers(std::string_view text, const std::string& file, std::size_t number) {
  std::vector<std::int64_t> all;
  for (const char *at = text.data(), *const last = at + text.size();;) {
    while (at != last && *at == ' ') ++at;
    std::int64_t value = 0;
    const auto [end, fault] = std::from_chars(at, last, value);
    if (fault != std::errc{} || (end != last && *end != ','))
      throw Error::at(file, number, "a mask is \"m\" and whole numbers");
    all.push_back(value);
    if (end == last) return all;
    at = end + 1;
  }
}

/// The box around the pixels of a mask: left, top, width, height, then how many pixels are off, on, off …,
/// row by row.
std::optional<Box> around_mask(std::string_view text, const std::string& file, std::size_t number) {
  const auto cells = whole_numbers(text, file, number);
  const auto wrong = [&](std::string_view what) { throw Error::at(file, number, what); };
  if (cells.size() < 4) wrong("a mask needs left, top, width and height");
  const std::int64_t width = cells[2], height = cells[3];
  if (width < 0 || height < 0 ||
      std::max({std::abs(cells[0]), std::abs(cells[1]), width, height}) > kLargestMask_px)
    wrong("this mask is too large for a picture");
  std::int64_t at = 0, left = width, right = 0, top = height, bottom = 0;
  for (std::size_t i = 4; i < cells.size(); ++i) {
    if (cells[i] < 0 || cells[i] > width * height - at) wrong("this mask has more pixels than its size");
    const std::int64_t end = at + cells[i];
    if (i % 2 == 1 && end > at) {
      const bool one_row = at / width == (end - 1) / width;
      left = std::min(left, one_row ? at % width : 0);
      right = std::max(right, one_row ? (end - 1) % width + 1 : width);
      top = std::min(top, at / width);
      bottom = std::max(bottom, (end - 1) / width + 1);
    }
    at = end;
  }
  if (right <= left) return {};
  return Box{static_cast<double>(cells[0] + left) - 0.5, static_cast<double>(cells[1] + top) - 0.5,
             static_cast<double>(right - left), static_cast<double>(bottom - top)};
}

double turn(Vec2 a, Vec2 b, Vec2 c) {
  const Vec2 u = b - a, v = c - b;
  return u.x * v.y - u.y * v.x;
}

/// A quad of four points that turn one way all round, its corners clockwise; else the box around all points.
std::optional<Outline> around_points(const std::vector<double>& cells) {
  std::vector<Vec2> points;
  for (std::size_t i = 0; i + 1 < cells.size(); i += 2)
    points.push_back(Vec2{cells[i], cells[i + 1]} - kHalfPixel);
  if (points.size() == 4) {
    int right = 0, left = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const double t = turn(points[i], points[(i + 1) % 4], points[(i + 2) % 4]);
      right += t > kSmallestOutline_px ? 1 : 0;
      left += t < -kSmallestOutline_px ? 1 : 0;
    }
    if (left == 4) std::swap(points[1], points[3]);
    if (left == 4 || right == 4) return Quad{{points[0], points[1], points[2], points[3]}};
  }
  Vec2 low = points[0], high = points[0];
  for (const Vec2 p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  if (high.x - low.x < kSmallestOutline_px || high.y - low.y < kSmallestOutline_px) return {};
  return Box{low.x, low.y, high.x - low.x, high.y - low.y};
}

}  // namespace

std::optional<Outline> vot_region(std::string_view line, const std::string& file, std::size_t number) {
  if (line.starts_with('m')) return around_mask(line.substr(1), file, number);
  const auto cells = numbers_of(line, file, number);
  const bool nan = std::any_of(cells.begin(), cells.end(), [](double cell) { return std::isnan(cell); });
  if (cells.size() == 1 && (nan || cells[0] == 0)) return {};
  if (cells.size() == 4) return box_of(cells, Origin::zero, file, number);
  if (cells.size() >= 6 && cells.size() % 2 == 0) return nan ? std::nullopt : around_points(cells);
  throw Error::at(file, number,
                  "a region is a box of four numbers, a polygon of three points or more, or a mask");
}

}  // namespace relock
