#include "sequences/simulator/camera.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/error.h"

namespace relock::simulator {
namespace {

/// Of the distorted radius by the undistorted one.
double radial_slope(const Camera& camera, double r2) { return 1 + r2 * (3 * camera.k1 + 5 * camera.k2 * r2); }
double radial_factor(const Camera& camera, double r2) { return 1 + r2 * (camera.k1 + camera.k2 * r2); }

/// Whether radii up to this one are seen one to one. The slope is a parabola in r^2.
bool one_to_one(const Camera& camera, double r2) {
  if (radial_slope(camera, r2) <= 0) return false;
  if (camera.k2 <= 0) return true;  // it only falls faster farther out
  const double lowest_at = -3 * camera.k1 / (10 * camera.k2);
  return lowest_at <= 0 || lowest_at >= r2 || radial_slope(camera, lowest_at) > 0;
}

/// The normalised radius that is seen at `distorted`; negative where there is none.
double undistorted_radius(const Camera& camera, double distorted) {
  double r = distorted;
  for (int i = 0; i < 50; ++i) {
    const double slope = radial_slope(camera, r * r);
    if (slope <= 0) return -1;
    const double step = (r * radial_factor(camera, r * r) - distorted) / slope;
    r -= step;
    if (std::abs(step) < 1e-14 * (1 + r)) return r;
  }
  return -1;
}

}  // namespace

double focal_of_diagonal(Size picture, double diagonal_deg) {
  const double half = std::hypot(picture.width, picture.height) / 2;
  return half / std::tan(diagonal_deg / 2 * std::numbers::pi / 180);
}

void check_camera(const Camera& camera) {
  const auto [width, height] = camera.picture;
  if (width < 16 || height < 16 || width > 8192 || height > 8192)
    throw Error(fmt::format("camera: a picture of {}x{} cannot be made; each side must be from 16 to 8192 px",
                            width, height));
  if (!(camera.focal_px > 1 && camera.focal_px < 1e6))
    throw Error(fmt::format("camera: a focal length of {} px is none", camera.focal_px));
  const double corner = std::hypot(camera.middle().x + 1, camera.middle().y + 1) / camera.focal_px;
  const double radius = undistorted_radius(camera, corner);
  if (radius < 0 || !one_to_one(camera, radius * radius))
    throw Error(fmt::format("camera: k1 {} and k2 {} fold the picture over before its corners", camera.k1,
                            camera.k2));
}

std::optional<Vec2> project(const Camera& camera, const Eigen::Vector3d& point) {
  if (point.z() < 1e-6) return {};
  const Eigen::Vector2d place = point.head<2>() / point.z();
  const double r2 = place.squaredNorm();
  if (!one_to_one(camera, r2)) return {};
  const double scale = camera.focal_px * radial_factor(camera, r2);
  return camera.middle() + Vec2{scale * place.x(), scale * place.y()};
}

Eigen::Vector2d normalised(const Camera& camera, Vec2 pixel) {
  const Vec2 off = (1 / camera.focal_px) * (pixel - camera.middle());
  const double distorted = norm(off);
  if (distorted == 0 || (camera.k1 == 0 && camera.k2 == 0)) return {off.x, off.y};
  const double scale = undistorted_radius(camera, distorted) / distorted;
  return {scale * off.x, scale * off.y};
}

std::string calibration_text(const Camera& camera) {
  const auto matrix = [](int rows, int cols, std::string_view data) {
    return fmt::format("!!opencv-matrix\n   rows: {}\n   cols: {}\n   dt: d\n   data: [ {} ]\n", rows, cols,
                       data);
  };
  const Vec2 middle = camera.middle();
  return fmt::format(
      "%YAML:1.0\n---\nimage_width: {}\nimage_height: {}\ncamera_matrix: {}distortion_coefficients: {}",
      camera.picture.width, camera.picture.height,
      matrix(3, 3,
             fmt::format("{0}, 0., {1}, 0., {0}, {2}, 0., 0., 1.", camera.focal_px, middle.x, middle.y)),
      matrix(5, 1, fmt::format("{}, {}, 0., 0., 0.", camera.k1, camera.k2)));
}

Pose between(const Pose& a, const Pose& b, double share) {
  Pose pose;
  pose.position = a.position + share * (b.position - a.position);
  const double sign = a.rotation.dot(b.rotation) < 0 ? -1 : 1;
  pose.rotation.coeffs() = (1 - share) * a.rotation.coeffs() + share * sign * b.rotation.coeffs();
  pose.rotation.normalize();
  return pose;
}

}  // namespace relock::simulator
