#include "detectors/ring/exposure.h"

#include <algorithm>
#include <cmath>

namespace relock::ring {
namespace {

constexpr float kLeastDepth = 0.2f;   // a view that is possible has more; a step of a fit may try less
constexpr float kSampleStep = 0.03f;  // of short movements, in the marker's plane
/// Within this much of the sheet's edge its softness begins to show.
constexpr float kEdge = 0.06f;

float squared_length(float x, float y) { return x * x + y * y; }

/// Mean over a short movement: at the middles of `samples` parts, each smoothed by its own length, which makes so
/// few of them enough.
SweptLight sampled(const RadialProfile& profile, const float q[2], const float u[2], float sigma, int samples) {
  SweptLight sum;
  const float step = 1 / static_cast<float>(samples);
  for (int k = 0; k < samples; ++k) {
    const float t = (static_cast<float>(k) + 0.5f) * step - 0.5f;
    const float x = q[0] + t * u[0], y = q[1] + t * u[1];
    const float radius = std::sqrt(squared_length(x, y) + 1e-8f), inverse = 1 / radius;
    const float along = (x * u[0] + y * u[1]) * inverse * step;
    const Rise rise = profile.at(radius, std::sqrt(sigma * sigma + along * along / 12));
    const float gx = rise.slope * x * inverse, gy = rise.slope * y * inverse;
    sum.mean += rise.value;
    sum.by_q[0] += gx, sum.by_q[1] += gy;
    sum.by_u[0] += t * gx, sum.by_u[1] += t * gy;
  }
  for (float* value : {&sum.mean, &sum.by_q[0], &sum.by_q[1], &sum.by_u[0], &sum.by_u[1]}) *value *= step;
  return sum;
}

}  // namespace

Exposure::Exposure(RingModel& model, MovingRings& rings, const View& view, double psf_px)
    : rings_(rings.still()),
      sheet_(model.sheet().still()),
      centre_{static_cast<float>(view.centre.x()), static_cast<float>(view.centre.y())},
      s_{{static_cast<float>(view.xx), static_cast<float>(view.xy)},
         {static_cast<float>(view.xy), static_cast<float>(view.yy)}},
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

Exposure::Local Exposure::local(float x, float y) const {
  Local l{};
  l.dx = x - centre_[0], l.dy = y - centre_[1];
  l.depth = std::max(1 + v_[0] * l.dx + v_[1] * l.dy, kLeastDepth);
  const float near = 1 / l.depth;
  l.q[0] = (s_[0][0] * l.dx + s_[0][1] * l.dy) * near;
  l.q[1] = (s_[1][0] * l.dx + s_[1][1] * l.dy) * near;
  for (int row = 0; row < 2; ++row)
    for (int column = 0; column < 2; ++column) l.j[row][column] = (s_[row][column] - l.q[row] * v_[column]) * near;
  l.u[0] = l.j[0][0] * b_[0] + l.j[0][1] * b_[1];
  l.u[1] = l.j[1][0] * b_[0] + l.j[1][1] * b_[1];
  const float inverse = 1 / std::sqrt(squared_length(l.q[0], l.q[1]) + 1e-6f);
  const float nx = (l.j[0][0] * l.q[0] + l.j[1][0] * l.q[1]) * inverse;
  const float ny = (l.j[0][1] * l.q[0] + l.j[1][1] * l.q[1]) * inverse;
  l.sigma = psf_ * std::sqrt(squared_length(nx, ny));
  return l;
}

SweptLight Exposure::light_of(const RadialProfile& still, const SweptProfile* swept, const Local& l) const {
  return swept ? swept->at(l.q, l.u) : sampled(still, l.q, l.u, l.sigma, samples_);
}

Gradient Exposure::gradient(const Local& l, const SweptLight& s) const {
  // With d = p - c and w the depth: q = S d / w and u = (S b - q (v.b)) / w, each by each unknown.
  const float near = 1 / l.depth, vb = v_[0] * b_[0] + v_[1] * b_[1];
  const float gx = s.by_q[0], gy = s.by_q[1], hx = s.by_u[0], hy = s.by_u[1];
  // A change of q by dq also changes u by -dq (v.b) / w: both together weigh
  const float ax = gx - hx * vb * near, ay = gy - hy * vb * near;
  const float hu = hx * l.u[0] + hy * l.u[1];
  Gradient g;
  g[kCentreX] = -(ax * l.j[0][0] + ay * l.j[1][0]) + hu * v_[0] * near;
  g[kCentreY] = -(ax * l.j[0][1] + ay * l.j[1][1]) + hu * v_[1] * near;
  g[kXX] = (ax * l.dx + hx * b_[0]) * near;
  g[kXY] = (ax * l.dy + ay * l.dx + hx * b_[1] + hy * b_[0]) * near;
  g[kYY] = (ay * l.dy + hy * b_[1]) * near;
  g[kBlurX] = hx * l.j[0][0] + hy * l.j[1][0];
  g[kBlurY] = hx * l.j[0][1] + hy * l.j[1][1];
  g[kGain] = g[kOffset] = g[kLeak] = 0;
  const float aq = ax * l.q[0] + ay * l.q[1], hq = hx * l.q[0] + hy * l.q[1];
  g[kVanishingX] = -(aq * l.dx + hu * l.dx + hq * b_[0]) * near;
  g[kVanishingY] = -(aq * l.dy + hu * l.dy + hq * b_[1]) * near;
  return g;
}

Prediction Exposure::at(float x, float y, const Light& light) const {
  const Local l = local(x, y);
  const SweptLight rings = light_of(rings_, swept_rings_, l);
  const auto gain = static_cast<float>(light.gain), leak = static_cast<float>(light.leak);
  SweptLight sum{gain * rings.mean,
                 {gain * rings.by_q[0], gain * rings.by_q[1]},
                 {gain * rings.by_u[0], gain * rings.by_u[1]}};
  Prediction out;
  if (farthest(l) > sheet_radius_ - kEdge) {
    const SweptLight sheet = light_of(sheet_, swept_sheet_, l);
    out.leaked = 1 - sheet.mean;
    for (int k = 0; k < 2; ++k) sum.by_q[k] -= leak * sheet.by_q[k], sum.by_u[k] -= leak * sheet.by_u[k];
  }
  out.grey = sum.mean + static_cast<float>(light.offset) + leak * out.leaked;
  out.gradient = gradient(l, sum);
  out.gradient[kGain] = rings.mean, out.gradient[kOffset] = 1, out.gradient[kLeak] = out.leaked;
  return out;
}

float Exposure::rings_at(float x, float y) const { return light_of(rings_, swept_rings_, local(x, y)).mean; }

float Exposure::leaked_at(float x, float y) const {
  const Local l = local(x, y);
  return farthest(l) > sheet_radius_ - kEdge ? 1 - light_of(sheet_, swept_sheet_, l).mean : 0;
}

float Exposure::farthest(float x, float y) const { return farthest(local(x, y)); }

float Exposure::farthest(const Local& l) const {
  const float hx = 0.5f * l.u[0], hy = 0.5f * l.u[1];
  return std::sqrt(std::max(squared_length(l.q[0] + hx, l.q[1] + hy), squared_length(l.q[0] - hx, l.q[1] - hy)));
}

}  // namespace relock::ring
