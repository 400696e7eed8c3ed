#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/geometry.h"

// The functions of core/geometry.h. They are in a header so that a plug-in has them without linking relock.

namespace relock {

/// One function of several lambdas, for std::visit.
template <class... Ts>
struct overloaded : Ts... {
  using Ts::operator()...;
};
template <class... Ts>
overloaded(Ts...) -> overloaded<Ts...>;  // clang 14 does not find it by itself

namespace geometry {

inline double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }

/// Twice the signed area of a polygon.
template <class Polygon>
inline double doubled_area(const Polygon& polygon) {
  double sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    sum += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return sum;
}

inline Vec2 centroid(const Quad& quad) {
  // Relative to the first corner, so that a far-away quad loses no digits.
  const Vec2 origin = quad.corner[0];
  double area = 0;
  Vec2 moment;
  for (std::size_t i = 1; i + 1 < 4; ++i) {
    const Vec2 a = quad.corner[i] - origin, b = quad.corner[i + 1] - origin;
    const double triangle = cross(a, b);
    area += triangle;
    moment = moment + (triangle / 3.0) * (a + b);
  }
  if (area == 0) {
    return 0.25 * (quad.corner[0] + quad.corner[1] + quad.corner[2] + quad.corner[3]);
  }
  return origin + (1.0 / area) * moment;
}

}  // namespace geometry

inline double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
inline double norm(Vec2 a) { return std::hypot(a.x, a.y); }
inline double between_axes(double a_rad, double b_rad) {
  const double apart = std::fmod(std::abs(a_rad - b_rad), std::numbers::pi);
  return std::min(apart, std::numbers::pi - apart);
}
inline bool finite(Vec2 a) { return std::isfinite(a.x) && std::isfinite(a.y); }

inline Vec2 centre_of(const Outline& outline) {
  return std::visit(overloaded{[](const Box& b) {
                                 return Vec2{b.x + b.width / 2, b.y + b.height / 2};
                               },
                               [](const Quad& q) { return geometry::centroid(q); },
                               [](const Ellipse& e) { return e.centre; }},
                    outline);
}

inline Vec2 diagonals_meet(const Quad& quad) {
  const Vec2 p = quad.corner[0], d = quad.corner[2] - quad.corner[0];
  const Vec2 q = quad.corner[1], e = quad.corner[3] - quad.corner[1];
  const double denominator = geometry::cross(d, e);
  if (denominator == 0) return geometry::centroid(quad);
  return p + (geometry::cross(q - p, e) / denominator) * d;
}

inline double size_of(const Outline& outline) {
  return std::visit(overloaded{[](const Box& b) { return std::sqrt(b.area()); },
                               [](const Quad& q) {
                                 double perimeter = 0;
                                 for (std::size_t i = 0; i < 4; ++i)
                                   perimeter += norm(q.corner[(i + 1) % 4] - q.corner[i]);
                                 return perimeter / 4;
                               },
                               [](const Ellipse& e) { return 2 * e.semi_major; }},
                    outline);
}

inline Box bounds(const Outline& outline) {
  return std::visit(overloaded{[](const Box& b) { return b; },
                               [](const Quad& q) {
                                 Vec2 low = q.corner[0], high = q.corner[0];
                                 for (const Vec2& c : q.corner) {
                                   low = {std::min(low.x, c.x), std::min(low.y, c.y)};
                                   high = {std::max(high.x, c.x), std::max(high.y, c.y)};
                                 }
                                 return Box{low.x, low.y, high.x - low.x, high.y - low.y};
                               },
                               [](const Ellipse& e) {
                                 const double c = std::cos(e.angle_rad), s = std::sin(e.angle_rad);
                                 const double dx = std::hypot(e.semi_major * c, e.semi_minor * s);
                                 const double dy = std::hypot(e.semi_major * s, e.semi_minor * c);
                                 return Box{e.centre.x - dx, e.centre.y - dy, 2 * dx, 2 * dy};
                               }},
                    outline);
}

inline bool well_formed(const Outline& outline) {
  return std::visit(
      overloaded{[](const Box& b) {
                   return finite({b.x, b.y}) && finite({b.width, b.height}) && b.width > 0 && b.height > 0;
                 },
                 [](const Quad& q) {
                   return std::all_of(q.corner.begin(), q.corner.end(), finite) &&
                          geometry::doubled_area(q.corner) != 0;
                 },
                 [](const Ellipse& e) {
                   return finite(e.centre) && std::isfinite(e.angle_rad) && std::isfinite(e.semi_major) &&
                          e.semi_minor > 0 && e.semi_major >= e.semi_minor;
                 }},
      outline);
}

inline Box intersect(const Box& a, const Box& b) {
  const double x = std::max(a.x, b.x), y = std::max(a.y, b.y);
  return {x, y, std::max(0.0, std::min(a.right(), b.right()) - x),
          std::max(0.0, std::min(a.bottom(), b.bottom()) - y)};
}

inline double intersection_over_union(const Box& a, const Box& b) {
  const double common = intersect(a, b).area();
  const double all = a.area() + b.area() - common;
  return all > 0 ? common / all : 0.0;
}

inline Box picture_box(Size picture) {
  return {-0.5, -0.5, static_cast<double>(picture.width), static_cast<double>(picture.height)};
}

}  // namespace relock
