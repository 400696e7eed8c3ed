#pragma once

#include <array>
#include <variant>

namespace relock {

// Coordinates are pixels: x to the right, y down, pixel CENTRES at integers, so the pixel in column 10 covers
// x from 9.5 to 10.5 and a picture of width w covers x from -0.5 to w - 0.5. OpenCV's functions on points use
// the same convention; its integer rectangle {10, 10, 20, 20} covers x from 9.5 to 29.5, which is
// Box{9.5, 9.5, 20, 20} here (core/opencv.h converts).

/// A point or a vector, px. Plain on purpose: Eigen members change alignment with compiler flags.
struct Vec2 {
  double x = 0;
  double y = 0;

  friend bool operator==(const Vec2&, const Vec2&) = default;
  friend Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
  friend Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
  friend Vec2 operator*(double s, Vec2 a) { return {s * a.x, s * a.y}; }
};
inline double dot(Vec2 a, Vec2 b);
inline double norm(Vec2 a);
inline bool finite(Vec2 a);

/// The angle between two directions without a sense, in [0, pi/2] rad.
inline double between_axes(double a_rad, double b_rad);

/// Width and height of a picture, px.
struct Size {
  int width = 0;
  int height = 0;
  friend bool operator==(const Size&, const Size&) = default;
};

/// An upright rectangle given by its left and top edges.
struct Box {
  double x = 0;       ///< left edge, px
  double y = 0;       ///< top edge, px
  double width = 0;   ///< px
  double height = 0;  ///< px

  double right() const { return x + width; }
  double bottom() const { return y + height; }
  double area() const { return width * height; }
  friend bool operator==(const Box&, const Box&) = default;
};

/// Four corners in the order top left, top right, bottom right, bottom left of the upright target.
struct Quad {
  std::array<Vec2, 4> corner;
  friend bool operator==(const Quad&, const Quad&) = default;
};

struct Ellipse {
  Vec2 centre;            ///< px
  double semi_major = 0;  ///< px
  double semi_minor = 0;  ///< px
  double angle_rad = 0;   ///< direction of the major axis from +x towards +y, in [0, pi)
  friend bool operator==(const Ellipse&, const Ellipse&) = default;
};

/// The outline of a whole target in a picture.
using Outline = std::variant<Box, Quad, Ellipse>;

/// Centre of the outline: middle of a box, centroid of a quad's area, centre of an ellipse.
inline Vec2 centre_of(const Outline& outline);
/// Where the diagonals of a quad meet: the image of a square's physical centre under any perspective.
inline Vec2 diagonals_meet(const Quad& quad);
/// Size D of metrics.md section 1: square root of a box's area, side of the square with a quad's perimeter,
/// major axis of an ellipse; px.
inline double size_of(const Outline& outline);
/// The smallest box around the outline.
inline Box bounds(const Outline& outline);
/// Every number finite, and nothing of zero or negative size.
inline bool well_formed(const Outline& outline);

/// Part of the two boxes' union that both cover, in [0, 1]. Continuous: no inclusive pixels.
inline double intersection_over_union(const Box& a, const Box& b);
/// The common part; of zero size when there is none.
inline Box intersect(const Box& a, const Box& b);
/// The box that a picture covers: from -0.5 to width - 0.5.
inline Box picture_box(Size picture);
/// Part of the outline's area that lies inside `box`, in [0, 1].
double share_inside(const Outline& outline, const Box& box);

}  // namespace relock

#include "core/geometry_inline.h"  // the functions, for plug-ins too: they link nothing
