#include "core/geometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace relock {
namespace {

std::vector<Vec2> polygon_of(const Outline& outline) {
  return std::visit(
      overloaded{[](const Box& b) {
                   return std::vector<Vec2>{
                       {b.x, b.y}, {b.right(), b.y}, {b.right(), b.bottom()}, {b.x, b.bottom()}};
                 },
                 [](const Quad& q) { return std::vector<Vec2>(q.corner.begin(), q.corner.end()); },
                 [](const Ellipse& e) {
                   constexpr int kSides = 256;  // area 0.01 % below the ellipse's
                   std::vector<Vec2> points;
                   const double c = std::cos(e.angle_rad), s = std::sin(e.angle_rad);
                   for (int i = 0; i < kSides; ++i) {
                     const double t = 2 * std::numbers::pi * i / kSides;
                     const double u = e.semi_major * std::cos(t), v = e.semi_minor * std::sin(t);
                     points.push_back({e.centre.x + c * u - s * v, e.centre.y + s * u + c * v});
                   }
                   return points;
                 }},
      outline);
}

/// Keeps the part of a polygon where inside(p) >= 0, `inside` being linear (Sutherland and Hodgman 1974).
template <class Inside>
std::vector<Vec2> clip(const std::vector<Vec2>& polygon, Inside inside) {
  std::vector<Vec2> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const double da = inside(a), db = inside(b);
    if (da >= 0) kept.push_back(a);
    if ((da >= 0) != (db >= 0)) kept.push_back(a + (da / (da - db)) * (b - a));
  }
  return kept;
}

}  // namespace

double share_inside(const Outline& outline, const Box& box) {
  const auto whole = polygon_of(outline);
  auto part = clip(whole, [&](Vec2 p) { return p.x - box.x; });
  part = clip(part, [&](Vec2 p) { return box.right() - p.x; });
  part = clip(part, [&](Vec2 p) { return p.y - box.y; });
  part = clip(part, [&](Vec2 p) { return box.bottom() - p.y; });
  const double area = std::abs(geometry::doubled_area(whole));
  return area > 0 ? std::min(1.0, std::abs(geometry::doubled_area(part)) / area) : 0.0;
}

}  // namespace relock
