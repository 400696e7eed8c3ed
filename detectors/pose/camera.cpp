#include "detectors/pose/camera.h"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <vector>

#include "core/error.h"

namespace relock::pose {
namespace {

cv::Matx33d matrix_of(const Camera& camera) {
  return {camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1};
}
cv::Matx<double, 5, 1> distortion_of(const Camera& camera) {
  return cv::Matx<double, 5, 1>(camera.distortion.data());
}

}  // namespace

void check(const Camera& camera) {
  const auto& d = camera.distortion;
  const bool finite = std::isfinite(camera.cx) && std::isfinite(camera.cy) &&
                      std::all_of(d.begin(), d.end(), [](double k) { return std::isfinite(k); });
  if (!(camera.fx > 0 && camera.fy > 0 && std::isfinite(camera.fx) && std::isfinite(camera.fy)) || !finite)
    throw Error("a camera needs focal lengths above 0 px and finite numbers");
}

Eigen::Vector2d normalised(const Camera& camera, Vec2 pixel) {
  const std::vector<cv::Point2d> seen{{pixel.x, pixel.y}};
  std::vector<cv::Point2d> ideal;
  cv::undistortPoints(seen, ideal, matrix_of(camera), distortion_of(camera), cv::noArray(), cv::noArray(),
                      cv::TermCriteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 50, 1e-12));
  return {ideal.front().x, ideal.front().y};
}

Vec2 project(const Camera& camera, const Eigen::Vector3d& point) {
  const double x = point.x() / point.z(), y = point.y() / point.z(), r2 = x * x + y * y;
  const auto& [k1, k2, p1, p2, k3] = camera.distortion;
  const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const double u = x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x);
  const double v = y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y;
  return {camera.fx * u + camera.cx, camera.fy * v + camera.cy};
}

}  // namespace relock::pose
