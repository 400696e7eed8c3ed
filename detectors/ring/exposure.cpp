#include "detectors/ring/exposure.h"

#include <algorithm>
#include <cmath>

#include "detectors/ring/vector_clones.h"

namespace relock::ring {

/// Where the pixels of a block are in the marker's plane.
struct Exposure::Places {
  alignas(32) Row dx, dy;              // p - c
  alignas(32) Row near;                // 1 / w
  alignas(32) Row qx, qy, ux, uy, k;   // the point and its movement (Movements)
  alignas(32) Row jxx, jxy, jyx, jyy;  // dq/dp
  alignas(32) Row variance;            // of lens and pixel along the radius
};

namespace {

constexpr float kLeastDepth = 0.2f;   // a view that is possible has more; a step of a fit may try less
constexpr float kSampleStep = 0.03f;  // of short movements, in the marker's plane
/// Within this much of the sheet's edge its softness begins to show.
constexpr float kEdge = 0.06f;

}  // namespace

Exposure::Exposure(RingModel& model, MovingRings& rings, const View& view, double psf_px)
    : rings_(rings.still()),
      sheet_(model.sheet().still()),
      centre_{static_cast<float>(view.centre.x()), static_cast<float>(view.centre.y())},
      s_{static_cast<float>(view.xx), static_cast<float>(view.xy), static_cast<float>(view.yy)},
      v_{static_cast<float>(view.vanishing.x()), static_cast<float>(view.vanishing.y())},
      b_{static_cast<float>(view.blur.x()), static_cast<float>(view.blur.y())},
      psf_(static_cast<float>(psf_px)),
      sheet_radius_(static_cast<float>(model.geometry().quiet_zone)) {
  const Eigen::Vector2d movement = view.shape() * view.blur;
  const double length = movement.norm();
  samples_ = std::clamp(static_cast<int>(std::ceil(length / kSampleStep)), 1, 5);
  // Perspective makes the movement shorter where the marker is farther away.
  if (length < 1.5 * SweptProfile::kShortest) return;
  // Along the movement the lens does not count; across it, it does.
  const Eigen::Vector2d across = Eigen::Vector2d(-movement.y(), movement.x()) / length;
  const double sigma = psf_px * (view.shape() * across).norm();
  swept_rings_ = &rings.swept(sigma);
  swept_sheet_ = &model.sheet().swept(sigma);
}

RELOCK_VECTOR_CLONES
void Exposure::place(const float* x, const float* y, int n, Places& out) const {
  const float sxx = s_[0], sxy = s_[1], syy = s_[2], vx = v_[0], vy = v_[1], bx = b_[0], by = b_[1];
  const float cx = centre_[0], cy = centre_[1], psf2 = psf_ * psf_;
  RELOCK_INDEPENDENT
  for (int i = 0; i < n; ++i) {
    const float dx = x[i] - cx, dy = y[i] - cy;
    const float depth = 1 + vx * dx + vy * dy;
    const float near = 1 / (depth > kLeastDepth ? depth : kLeastDepth);
    const float qx = (sxx * dx + sxy * dy) * near, qy = (sxy * dx + syy * dy) * near;
    const float jxx = (sxx - qx * vx) * near, jxy = (sxy - qx * vy) * near;
    const float jyx = (sxy - qy * vx) * near, jyy = (syy - qy * vy) * near;
    const float nx = jxx * qx + jyx * qy, ny = jxy * qx + jyy * qy;
    out.dx[i] = dx, out.dy[i] = dy, out.near[i] = near;
    out.k[i] = (vx * bx + vy * by) * near;
    out.qx[i] = qx, out.qy[i] = qy;
    out.ux[i] = jxx * bx + jxy * by, out.uy[i] = jyx * bx + jyy * by;
    out.jxx[i] = jxx, out.jxy[i] = jxy, out.jyx[i] = jyx, out.jyy[i] = jyy;
    out.variance[i] = psf2 * (nx * nx + ny * ny) / (qx * qx + qy * qy + 1e-6f);
  }
}

void Exposure::light_of(const RadialProfile& still, const SweptProfile* swept, const Places& at, int n,
                        SweptLight& out) const {
  const Movements moved{at.qx, at.qy, at.ux, at.uy, at.k};
  if (swept)
    swept->mean(moved, n, out);
  else
    still.mean(moved, at.variance, n, samples_, out);
}

bool Exposure::any_near_edge(const Places& at, int n) const {
  const float edge = (sheet_radius_ - kEdge) * (sheet_radius_ - kEdge);
  float farthest = 0;
  for (int i = 0; i < n; ++i) {
    // The farther end of the movement is |q|^2 + |q.u| + |u|^2 / 4 from the middle.
    const float q2 = at.qx[i] * at.qx[i] + at.qy[i] * at.qy[i],
                u2 = at.ux[i] * at.ux[i] + at.uy[i] * at.uy[i];
    farthest = std::max(farthest, q2 + std::abs(at.qx[i] * at.ux[i] + at.qy[i] * at.uy[i]) + 0.25f * u2);
  }
  return farthest > edge;
}

/// With d = p - c and w the depth: q = S d / w and u = (S b - q (v.b)) / w, each by each unknown.
/// `g`: how the light changes with q, `h`: with u.
RELOCK_VECTOR_CLONES
void Exposure::chain(const Places& at, const SweptLight& light, const float* v, const float* b, int n,
                     Row* gradient) {
  const float vx = v[0], vy = v[1], bx = b[0], by = b[1], vb = vx * bx + vy * by;
  RELOCK_INDEPENDENT
  for (int i = 0; i < n; ++i) {
    const float near = at.near[i], dx = at.dx[i], dy = at.dy[i];
    const float hx = light.by_ux[i], hy = light.by_uy[i];
    // A change of q by dq also changes u by -dq (v.b) / w: both together weigh
    const float ax = light.by_qx[i] - hx * vb * near, ay = light.by_qy[i] - hy * vb * near;
    const float hu = hx * at.ux[i] + hy * at.uy[i];
    gradient[kCentreX][i] = hu * vx * near - (ax * at.jxx[i] + ay * at.jyx[i]);
    gradient[kCentreY][i] = hu * vy * near - (ax * at.jxy[i] + ay * at.jyy[i]);
    gradient[kXX][i] = (ax * dx + hx * bx) * near;
    gradient[kXY][i] = (ax * dy + ay * dx + hx * by + hy * bx) * near;
    gradient[kYY][i] = (ay * dy + hy * by) * near;
    gradient[kBlurX][i] = hx * at.jxx[i] + hy * at.jyx[i];
    gradient[kBlurY][i] = hx * at.jxy[i] + hy * at.jyy[i];
    const float along = ax * at.qx[i] + ay * at.qy[i] + hu, hq = hx * at.qx[i] + hy * at.qy[i];
    gradient[kVanishingX][i] = -(along * dx + hq * bx) * near;
    gradient[kVanishingY][i] = -(along * dy + hq * by) * near;
  }
}

void Exposure::predict(const float* x, const float* y, int n, const Light& light, Prediction& out) const {
  Places at;
  place(x, y, n, at);
  SweptLight rings, sheet;
  light_of(rings_, swept_rings_, at, n, rings);
  const bool leaks = any_near_edge(at, n);
  if (leaks) light_of(sheet_, swept_sheet_, at, n, sheet);
  const auto gain = static_cast<float>(light.gain), offset = static_cast<float>(light.offset);
  const auto leak = static_cast<float>(light.leak);
  SweptLight sum;
  for (int i = 0; i < n; ++i) {
    const float beyond = leaks ? 1 - sheet.mean[i] : 0;
    out.leaked[i] = beyond;
    out.grey[i] = offset + gain * rings.mean[i] + leak * beyond;
    out.gradient[kGain][i] = rings.mean[i], out.gradient[kOffset][i] = 1, out.gradient[kLeak][i] = beyond;
    sum.by_qx[i] = gain * rings.by_qx[i], sum.by_qy[i] = gain * rings.by_qy[i];
    sum.by_ux[i] = gain * rings.by_ux[i], sum.by_uy[i] = gain * rings.by_uy[i];
  }
  for (int i = 0; leaks && i < n; ++i) {
    sum.by_qx[i] -= leak * sheet.by_qx[i], sum.by_qy[i] -= leak * sheet.by_qy[i];
    sum.by_ux[i] -= leak * sheet.by_ux[i], sum.by_uy[i] -= leak * sheet.by_uy[i];
  }
  chain(at, sum, v_, b_, n, out.gradient);
}

void Exposure::rings(const float* x, const float* y, int n, float* light) const {
  Places at;
  SweptLight rings;
  place(x, y, n, at);
  light_of(rings_, swept_rings_, at, n, rings);
  std::copy_n(rings.mean, n, light);
}

void Exposure::leaked(const float* x, const float* y, int n, float* part) const {
  Places at;
  place(x, y, n, at);
  if (!any_near_edge(at, n)) {
    std::fill_n(part, n, 0.0f);
    return;
  }
  SweptLight sheet;
  light_of(sheet_, swept_sheet_, at, n, sheet);
  for (int i = 0; i < n; ++i) part[i] = 1 - sheet.mean[i];
}

}  // namespace relock::ring
