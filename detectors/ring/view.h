#pragma once

#include <Eigen/Core>

#include "core/geometry.h"
#include "core/sighting.h"

// How a ring marker lies in a picture. A point p of the picture is the point
//
//     q = S (p - c) / (1 + v . (p - c))
//
// of the marker's plane, where the outermost ring ends at |q| = 1. This is a homography without the turn of the
// marker about its own middle, which rings do not show: c is the image of the middle, S, symmetric and positive,
// the marker's size and foreshortening there, and v how fast it gets smaller towards where it is farther away.

namespace relock::ring {

struct View {
  Eigen::Vector2d centre{0, 0};     ///< c, px: the image of the marker's middle
  double xx = 1, xy = 0, yy = 1;    ///< S, 1/px
  Eigen::Vector2d vanishing{0, 0};  ///< v, 1/px: 1 + v . (p - c) = 0 is the vanishing line of the plane
  Eigen::Vector2d blur{0, 0};  ///< how far the picture moves during the exposure, px; either sign is the same

  Eigen::Matrix2d shape() const { return (Eigen::Matrix2d() << xx, xy, xy, yy).finished(); }
  double determinant() const { return xx * yy - xy * xy; }
  /// Radius of the circle of the same area as the outermost ring, where there is no perspective, px.
  double radius() const { return 1 / std::sqrt(determinant()); }
  /// Whether it is a marker at all: S positive, not seen from the edge, and the vanishing line does not cross the outermost
  /// ring.
  bool possible() const;
};

/// A circle of radius `radius_px` about `centre`, without blur.
View straight_on(Vec2 centre, double radius_px);
/// The view with an ellipse of these conjugate semi-diameters for the outermost ring: vectors from the centre, px,
/// each parallel to the tangent at the end of the other.
View with_diameters(Vec2 centre, const Eigen::Vector2d& a, const Eigen::Vector2d& b);

/// The same view in a picture whose pixels are `scale` times as large (the mean of scale x scale pixels each).
View in_larger_pixels(const View& view, int scale);
View in_smaller_pixels(const View& view, int scale);

/// The image of the outermost ring.
Ellipse outline_of(const View& view);

/// Direction and length of the blur.
BlurEstimate blur_of(const View& view);

/// A point of the picture in the marker's plane, with what is around it.
struct Placed {
  Eigen::Vector2d q;         ///< the point
  Eigen::Matrix2d moved_by;  ///< dq/dp
  double depth;              ///< w = 1 + v . (p - c)
};
Placed placed(const View& view, const Eigen::Vector2d& p);

}  // namespace relock::ring
