#include "sequences/labelling/outline_numbers.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace relock {
namespace {

constexpr double kRoot2 = std::numbers::sqrt2, kHalfTurn = std::numbers::pi;

OutlineNumbers numbers(const Box& box) {
  // Each edge is placed on its own, so a width is off by the root of two.
  return {
      centre_of(box), {std::log(box.width), std::log(box.height)}, {kRoot2 / box.width, kRoot2 / box.height}};
}

OutlineNumbers numbers(const Ellipse& e) {
  const double eccentric =
      std::max(e.semi_major - e.semi_minor, 0.01 * e.semi_major);  // a circle has no angle
  return {e.centre,
          {std::log(e.semi_major), std::log(e.semi_minor), e.angle_rad},
          {1 / e.semi_major, 1 / e.semi_minor, 1 / eccentric}};
}

OutlineNumbers numbers(const Quad& quad) {
  OutlineNumbers result;
  for (const Vec2 corner : quad.corner) result.middle = result.middle + 0.25 * corner;
  const double size = size_of(quad);
  result.shape = {std::log(size)};
  for (const Vec2 corner : quad.corner) {
    const Vec2 part = (1 / size) * (corner - result.middle);
    result.shape.insert(result.shape.end(), {part.x, part.y});
  }
  result.shape_per_px.assign(result.shape.size(), 1 / size);
  return result;
}

Outline outline(const OutlineNumbers& n, const Box&) {
  const double width = std::exp(n.shape[0]), height = std::exp(n.shape[1]);
  return Box{n.middle.x - width / 2, n.middle.y - height / 2, width, height};
}

Outline outline(const OutlineNumbers& n, const Ellipse&) {
  Ellipse e{n.middle, std::exp(n.shape[0]), std::exp(n.shape[1]), n.shape[2]};
  if (e.semi_minor > e.semi_major) {
    std::swap(e.semi_minor, e.semi_major);
    e.angle_rad += kHalfTurn / 2;
  }
  e.angle_rad -= kHalfTurn * std::floor(e.angle_rad / kHalfTurn);
  return e;
}

Outline outline(const OutlineNumbers& n, const Quad&) {
  Quad quad;
  const double size = std::exp(n.shape[0]);
  for (std::size_t i = 0; i < quad.corner.size(); ++i)
    quad.corner[i] = n.middle + size * Vec2{n.shape[1 + 2 * i], n.shape[2 + 2 * i]};
  return quad;
}

}  // namespace

OutlineNumbers numbers_of(const Outline& outline) {
  return std::visit([](const auto& each) { return numbers(each); }, outline);
}

void follow(OutlineNumbers& numbers, const OutlineNumbers& before, const Outline& of) {
  if (!std::holds_alternative<Ellipse>(of)) return;
  double& angle = numbers.shape[2];
  angle += kHalfTurn * std::round((before.shape[2] - angle) / kHalfTurn);
}

Outline outline_of(const OutlineNumbers& numbers, const Outline& like) {
  return std::visit([&](const auto& each) { return outline(numbers, each); }, like);
}

}  // namespace relock
