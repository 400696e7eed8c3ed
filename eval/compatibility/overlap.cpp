#include "eval/compatibility/overlap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace relock {
namespace {

/// Whole pixels, both ends included.
struct PixelBounds {
  int left, top, right, bottom;
  bool thin() const { return left >= right || top >= bottom; }
};

int whole(double coordinate) {
  return static_cast<int>(std::nearbyint(static_cast<float>(coordinate)));  // the toolkit keeps floats
}

struct WholeBox {
  int x, y, width, height;
  PixelBounds bounds() const { return {x, y, x + width - 1, y + height - 1}; }
};

struct WholePoint {
  int x, y;
};

/// A region of VOT: a box or four points.
struct WholeRegion {
  bool is_box = true;
  WholeBox box{};
  std::array<WholePoint, 4> points{};

  PixelBounds bounds() const {
    if (is_box) return box.bounds();
    const auto [left, right] = std::minmax({points[0].x, points[1].x, points[2].x, points[3].x});
    const auto [top, bottom] = std::minmax({points[0].y, points[1].y, points[2].y, points[3].y});
    return {left, top, right, bottom};
  }
};

WholeRegion whole_region(const Outline& outline) {
  WholeRegion region;
  const Outline vot = from_corner(outline);
  if (const auto* box = std::get_if<Box>(&vot)) {
    region.box = {whole(box->x), whole(box->y), whole(box->width), whole(box->height)};
    return region;
  }
  region.is_box = false;
  const Quad& quad = std::get<Quad>(vot);
  for (std::size_t i = 0; i < 4; ++i) region.points[i] = {whole(quad.corner[i].x), whole(quad.corner[i].y)};
  return region;
}

using Row = std::vector<std::uint8_t>;

void fill(Row& row, int from, int to) {
  const int last = static_cast<int>(row.size()) - 1;
  for (int x = std::max(from, 0); x <= std::min(to, last); ++x) row[static_cast<std::size_t>(x)] = 1;
}

/// Where edges cross or touch row y, as columns from the raster's left, rising. The toolkit cuts fractions
/// off towards the raster's left border, in double precision and this order of operations.
std::vector<int> crossings(const WholeRegion& region, int y, const PixelBounds& raster) {
  std::vector<int> found;
  for (std::size_t i = 0; i < 4; ++i) {
    const WholePoint a = region.points[i], b = region.points[(i + 3) % 4];
    if (y < std::min(a.y, b.y) || y > std::max(a.y, b.y)) continue;
    double x = a.x - raster.left;
    if (a.y != b.y) {
      const double along = static_cast<double>(y - a.y) / (b.y - a.y) * (b.x - a.x);
      x += along;
    }
    found.push_back(static_cast<int>(x));
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// Fills between crossings by pairs. Of two equal ones the first is passed over, unless they are the last:
/// a corner on the row is met by both its edges.
void fill_polygon_row(const WholeRegion& region, int y, const PixelBounds& raster, Row& row) {
  const std::vector<int> x = crossings(region, y, raster);
  const int width = static_cast<int>(row.size());
  for (std::size_t i = 0; i + 1 < x.size() && x[i] < width;) {
    if (x[i] == x[i + 1] && i + 2 < x.size()) {
      ++i;
      continue;
    }
    fill(row, x[i], x[i + 1]);
    i += 2;
  }
}

void fill_row(const WholeRegion& region, int y, const PixelBounds& raster, Row& row) {
  std::fill(row.begin(), row.end(), std::uint8_t{0});
  if (!region.is_box) return fill_polygon_row(region, y, raster, row);
  const PixelBounds box = region.box.bounds();
  if (y >= box.top && y <= box.bottom) fill(row, box.left - raster.left, box.right - raster.left);
}

double clamped(double value, double high) { return std::min(std::max(value, 0.0), high); }

Box bounded(const Box& box, Size picture) {
  const double width = picture.width, height = picture.height;
  const double x = clamped(box.x, width), y = clamped(box.y, height);
  return {x, y, clamped(box.width, width - x), clamped(box.height, height - y)};
}

}  // namespace

Box one_based(const Box& box) { return {box.x + 1.5, box.y + 1.5, box.width, box.height}; }

Outline from_corner(const Outline& outline) {
  if (const auto* quad = std::get_if<Quad>(&outline)) {
    Quad moved = *quad;
    for (Vec2& corner : moved.corner) corner = corner + Vec2{0.5, 0.5};
    return moved;
  }
  const Box box = bounds(outline);
  return Box{box.x + 0.5, box.y + 0.5, box.width, box.height};
}

double got10k_overlap(const Box& answer, const Box& truth, Size picture) {
  const Box a = bounded(one_based(answer), picture), b = bounded(one_based(truth), picture);
  const double common = intersect(a, b).area();
  const double all = a.area() + b.area() - common;
  return clamped(common / (all + std::numeric_limits<double>::epsilon()), 1.0);
}

double otb_overlap(const Box& answer, const Box& truth) {
  return std::min(1.0, intersection_over_union(answer, truth));
}

double vot_overlap(const Outline& answer, const Outline& truth, Size picture) {
  const WholeRegion a = whole_region(answer), b = whole_region(truth);
  const PixelBounds in_a = a.bounds(), in_b = b.bounds();
  const PixelBounds both{std::min(in_a.left, in_b.left), std::min(in_a.top, in_b.top),
                         std::max(in_a.right, in_b.right), std::max(in_a.bottom, in_b.bottom)};
  if (both.thin()) return 1;
  const PixelBounds raster{std::max(0, both.left), std::max(0, both.top),
                           std::min(picture.width - 1, both.right),
                           std::min(picture.height - 1, both.bottom)};
  if (raster.thin()) return 0;
  Row row_a(static_cast<std::size_t>(raster.right - raster.left + 1)), row_b = row_a;
  std::int64_t common = 0, all = 0;
  for (int y = raster.top; y <= raster.bottom; ++y) {
    fill_row(a, y, raster, row_a);
    fill_row(b, y, raster, row_b);
    for (std::size_t x = 0; x < row_a.size(); ++x) {
      common += row_a[x] & row_b[x];
      all += row_a[x] | row_b[x];
    }
  }
  return all > 0 ? static_cast<double>(common) / static_cast<double>(all) : 0;
}

}  // namespace relock
