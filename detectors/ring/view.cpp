#include "detectors/ring/view.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <numbers>

namespace relock::ring {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;

/// Of the determinant over the trace squared: the outermost ring is no flatter than 1 : 23, or is nothing to be read.
constexpr double kFlattest = 0.04;

Vector2d vector_of(Vec2 v) { return {v.x, v.y}; }

/// Takes a homogeneous point of the picture to the marker's plane.
Matrix3d homography_of(const View& view) {
  Matrix3d h;
  h.topLeftCorner<2, 2>() = view.shape();
  h.topRightCorner<2, 1>() = -view.shape() * view.centre;
  h.bottomLeftCorner<1, 2>() = view.vanishing.transpose();
  h(2, 2) = 1 - view.vanishing.dot(view.centre);
  return h;
}

double direction_of(const Vector2d& v) {
  const double angle = std::fmod(std::atan2(v.y(), v.x()) + 2 * std::numbers::pi, std::numbers::pi);
  return angle < std::numbers::pi ? angle : 0;
}

}  // namespace

bool View::possible() const {
  if (!(xx > 0 && determinant() > kFlattest * (xx + yy) * (xx + yy))) return false;
  // The depth is least on the outermost ring, where it is 1 / (1 + |S^-1 v|).
  return (shape().inverse() * vanishing).norm() < 1;
}

View straight_on(Vec2 centre, double radius_px) {
  View view;
  view.centre = vector_of(centre);
  view.xx = view.yy = 1 / radius_px;
  return view;
}

View with_diameters(Vec2 centre, const Vector2d& a, const Vector2d& b) {
  // The ellipse is A (unit circle) with A = [a b], so S^-2 = A A'.
  const Matrix2d spread = a * a.transpose() + b * b.transpose();
  Eigen::SelfAdjointEigenSolver<Matrix2d> solver;
  solver.computeDirect(spread);
  const Matrix2d shape = solver.operatorInverseSqrt();
  View view;
  view.centre = vector_of(centre);
  view.xx = shape(0, 0), view.xy = shape(0, 1), view.yy = shape(1, 1);
  return view;
}

View in_larger_pixels(const View& view, int scale) {
  // The first of the larger pixels covers the smaller ones from -0.5 to scale - 0.5.
  View out = view;
  const double middle = 0.5 * (scale - 1);
  out.centre = (view.centre - Vector2d::Constant(middle)) / scale;
  out.xx *= scale, out.xy *= scale, out.yy *= scale;
  out.vanishing *= scale;
  out.blur /= scale;
  return out;
}

View in_smaller_pixels(const View& view, int scale) {
  View out = view;
  const double middle = 0.5 * (scale - 1);
  out.centre = view.centre * scale + Vector2d::Constant(middle);
  out.xx /= scale, out.xy /= scale, out.yy /= scale;
  out.vanishing /= scale;
  out.blur *= scale;
  return out;
}

Ellipse outline_of(const View& view) {
  // The circle |q| = 1 is q' diag(1, 1, -1) q = 0; its image is p' H' diag(1, 1, -1) H p = 0.
  const Matrix3d h = homography_of(view);
  const Matrix3d conic = h.transpose() * Eigen::Vector3d(1, 1, -1).asDiagonal() * h;
  const Matrix2d quadratic = conic.topLeftCorner<2, 2>();
  const Vector2d centre = -quadratic.inverse() * conic.topRightCorner<2, 1>();
  const double level = -(centre.dot(conic.topRightCorner<2, 1>()) + conic(2, 2));
  Eigen::SelfAdjointEigenSolver<Matrix2d> solver;
  solver.computeDirect(quadratic / level);
  const Vector2d axis = solver.eigenvectors().col(0);  // of the smaller eigenvalue: the longer axis
  return {{centre.x(), centre.y()},
          1 / std::sqrt(solver.eigenvalues()(0)),
          1 / std::sqrt(solver.eigenvalues()(1)),
          direction_of(axis)};
}

BlurEstimate blur_of(const View& view) { return {direction_of(view.blur), view.blur.norm()}; }

Placed placed(const View& view, const Vector2d& p) {
  const Vector2d d = p - view.centre;
  const double depth = 1 + view.vanishing.dot(d);
  const Vector2d q = view.shape() * d / depth;
  return {q, (view.shape() - q * view.vanishing.transpose()) / depth, depth};
}

}  // namespace relock::ring
