#include <algorithm>
#include <cmath>

#include "tests/eval/naive_parts.h"

namespace relock::naive {
namespace {

double triangle_area(Vec2 a, Vec2 b, Vec2 c) {
  return ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2;
}
Vec2 triangle_centre(Vec2 a, Vec2 b, Vec2 c) { return {(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3}; }

// Centroid of the area: of the two triangles that a diagonal makes, weighted by their areas.
Vec2 quad_centre(const Quad& quad) {
  const auto& c = quad.corner;
  const double first = triangle_area(c[0], c[1], c[2]), second = triangle_area(c[0], c[2], c[3]);
  const Vec2 one = triangle_centre(c[0], c[1], c[2]), two = triangle_centre(c[0], c[2], c[3]);
  return {(first * one.x + second * two.x) / (first + second),
          (first * one.y + second * two.y) / (first + second)};
}

Box box_around(const Outline& outline) {
  if (const auto* box = std::get_if<Box>(&outline)) return *box;
  if (const auto* quad = std::get_if<Quad>(&outline)) {
    std::vector<double> xs, ys;
    for (const Vec2& c : quad->corner) {
      xs.push_back(c.x);
      ys.push_back(c.y);
    }
    std::sort(xs.begin(), xs.end());
    std::sort(ys.begin(), ys.end());
    return {xs.front(), ys.front(), xs.back() - xs.front(), ys.back() - ys.front()};
  }
  const auto& e = std::get<Ellipse>(outline);
  const double c = std::cos(e.angle_rad), s = std::sin(e.angle_rad);
  const double half_width = std::hypot(e.semi_major * c, e.semi_minor * s);
  const double half_height = std::hypot(e.semi_major * s, e.semi_minor * c);
  return {e.centre.x - half_width, e.centre.y - half_height, 2 * half_width, 2 * half_height};
}

double common_length(double a, double a_end, double b, double b_end) {
  return std::max(0.0, std::min(a_end, b_end) - std::max(a, b));
}

}  // namespace

double distance(Vec2 a, Vec2 b) { return std::hypot(a.x - b.x, a.y - b.y); }
double times(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }

Vec2 outline_centre(const Outline& outline) {
  if (const auto* box = std::get_if<Box>(&outline))
    return {box->x + box->width / 2, box->y + box->height / 2};
  if (const auto* quad = std::get_if<Quad>(&outline)) return quad_centre(*quad);
  return std::get<Ellipse>(outline).centre;
}

// D: quad: side of the square with the same perimeter; box: square root of the area; else the major axis.
double outline_size(const Outline& outline) {
  if (const auto* box = std::get_if<Box>(&outline)) return std::sqrt(box->width * box->height);
  if (const auto* quad = std::get_if<Quad>(&outline)) {
    const auto& c = quad->corner;
    return (distance(c[0], c[1]) + distance(c[1], c[2]) + distance(c[2], c[3]) + distance(c[3], c[0])) / 4;
  }
  return 2 * std::get<Ellipse>(outline).semi_major;
}

double overlap(const Outline& first, const Outline& second) {
  const Box a = box_around(first), b = box_around(second);
  const double common = common_length(a.x, a.x + a.width, b.x, b.x + b.width) *
                        common_length(a.y, a.y + a.height, b.y, b.y + b.height);
  const double either = a.width * a.height + b.width * b.height - common;
  return either > 0 ? common / either : 0;
}

Vec2 matching_centre(const TargetTruth& truth, CentreKind kind) {
  if (kind == CentreKind::projected && truth.centre_projected) return *truth.centre_projected;
  return outline_centre(*truth.outline);
}

}  // namespace relock::naive
