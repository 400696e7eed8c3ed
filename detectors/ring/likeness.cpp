#include "detectors/ring/likeness.h"

#include <Eigen/LU>
#include <array>
#include <cmath>

namespace relock::ring {
namespace {

constexpr int kPoints = 64, kFewest = 18;
constexpr double kReach = 1.1;

/// Vogel's spiral: every point has as much area to itself as any other.
const std::array<Eigen::Vector2d, kPoints>& sunflower() {
  static const auto points = [] {
    std::array<Eigen::Vector2d, kPoints> made;
    const double golden_angle = M_PI * (3 - std::sqrt(5.0));
    for (int i = 0; i < kPoints; ++i)
      made[static_cast<std::size_t>(i)] =
          kReach * std::sqrt((i + 0.5) / kPoints) *
          Eigen::Vector2d(std::cos(i * golden_angle), std::sin(i * golden_angle));
    return made;
  }();
  return points;
}

/// Linearly between pixels; nothing outside.
bool read(const cv::Mat& gray, const Eigen::Vector2d& p, double& grey) {
  const int x = static_cast<int>(std::floor(p.x())), y = static_cast<int>(std::floor(p.y()));
  if (x < 0 || y < 0 || x + 1 >= gray.cols || y + 1 >= gray.rows) return false;
  const double fx = p.x() - x, fy = p.y() - y;
  const std::uint8_t *above = gray.ptr<std::uint8_t>(y) + x, *below = gray.ptr<std::uint8_t>(y + 1) + x;
  grey = (1 - fy) * ((1 - fx) * above[0] + fx * above[1]) + fy * ((1 - fx) * below[0] + fx * below[1]);
  return true;
}

}  // namespace

double likeness(const cv::Mat& gray, RingModel& model, std::size_t code, const View& view, double psf_px) {
  const Exposure exposure(model, code, view, psf_px);
  const Eigen::Matrix2d spread = view.shape().inverse();
  const Eigen::Vector2d half = 0.5 * view.shape() * view.blur;
  const double sheet = model.geometry().quiet_zone - 0.08;
  const double allowed = std::max(sheet, sheet - 0.05 + 0.84 * half.norm());
  float x[kPoints], y[kPoints], light[kPoints];
  double grey[kPoints];
  int n = 0;
  for (const Eigen::Vector2d& q : sunflower()) {
    if (std::max((q + half).squaredNorm(), (q - half).squaredNorm()) > allowed * allowed) continue;
    const Eigen::Vector2d d = spread * q;
    const Eigen::Vector2d p = view.centre + d / std::max(0.3, 1 - view.vanishing.dot(d));
    if (!read(gray, p, grey[n])) continue;
    x[n] = static_cast<float>(p.x()), y[n] = static_cast<float>(p.y()), ++n;
  }
  if (n < kFewest) return -1;
  for (int from = 0; from < n; from += kBlock)
    exposure.rings(x + from, y + from, std::min(kBlock, n - from), light + from);
  double is = 0, is_squares = 0, should = 0, should_squares = 0, both = 0;
  for (int i = 0; i < n; ++i) {
    is += grey[i], is_squares += grey[i] * grey[i];
    should += light[i], should_squares += light[i] * light[i], both += light[i] * grey[i];
  }
  const double variances = (is_squares - is * is / n) * (should_squares - should * should / n);
  return variances > 1e-6 ? (both - is * should / n) / std::sqrt(variances) : -1;
}

}  // namespace relock::ring
