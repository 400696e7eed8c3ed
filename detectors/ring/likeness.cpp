#include "detectors/ring/likeness.h"

#include <Eigen/LU>
#include <array>
#include <cmath>

namespace relock::ring {
namespace {

constexpr int kPoints = 64;
constexpr double kFewest = 0.28;  // of the points
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

/// Of a and b, what both owe to c left out: -1 to 1; -1 where one of them does not vary.
double partial_correlation(const double* a, const float* b, const float* c, int n) {
  double sa = 0, sb = 0, sc = 0, aa = 0, bb = 0, cc = 0, ab = 0, ac = 0, bc = 0;
  for (int i = 0; i < n; ++i) {
    const double x = a[i], y = b[i], z = c[i];
    sa += x, sb += y, sc += z, aa += x * x, bb += y * y, cc += z * z, ab += x * y, ac += x * z, bc += y * z;
  }
  aa -= sa * sa / n, bb -= sb * sb / n, cc -= sc * sc / n, ab -= sa * sb / n, ac -= sa * sc / n,
      bc -= sb * sc / n;
  if (cc > 1e-3 * n) aa -= ac * ac / cc, bb -= bc * bc / cc, ab -= ac * bc / cc;
  return aa * bb > 1e-6 ? ab / std::sqrt(aa * bb) : -1;
}

}  // namespace

double likeness(const cv::Mat& gray, RingModel& model, std::size_t code, const View& view, double psf_px,
                std::size_t one_point_of) {
  const Exposure exposure(model, code, view, psf_px);
  const Eigen::Matrix2d spread = view.shape().inverse();
  const Eigen::Vector2d half = 0.5 * view.shape() * view.blur;
  const double sheet = model.geometry().quiet_zone - 0.08;
  const double allowed = std::max(sheet, sheet - 0.05 + 0.84 * half.norm());
  float x[kPoints], y[kPoints], light[kPoints];
  double grey[kPoints];
  int n = 0;
  for (std::size_t i = 0; i < kPoints; i += one_point_of) {
    const Eigen::Vector2d& q = sunflower()[i];
    if (std::max((q + half).squaredNorm(), (q - half).squaredNorm()) > allowed * allowed) continue;
    const Eigen::Vector2d d = spread * q;
    const Eigen::Vector2d p = view.centre + d / std::max(0.3, 1 - view.vanishing.dot(d));
    if (!read(gray, p, grey[n])) continue;
    x[n] = static_cast<float>(p.x()), y[n] = static_cast<float>(p.y()), ++n;
  }
  if (n * static_cast<double>(one_point_of) < kFewest * kPoints) return -1;
  float leaked[kPoints];
  for (int from = 0; from < n; from += kBlock) {
    exposure.rings(x + from, y + from, std::min(kBlock, n - from), light + from);
    exposure.leaked(x + from, y + from, std::min(kBlock, n - from), leaked + from);
  }
  return partial_correlation(grey, light, leaked, n);
}

}  // namespace relock::ring
