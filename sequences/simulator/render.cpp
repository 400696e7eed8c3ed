#include "sequences/simulator/render.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace relock::simulator {
namespace {

constexpr float kOpaque = 0.999f;
/// Pixels of a row that share a level of a texture; rows are padded to whole pieces of this length.
constexpr int kChunk = 16;

Pixel4 load(const float* from) { return Pixel4{from[0], from[1], from[2], from[3]}; }

float clamp01(float x) { return std::clamp(x, 0.0f, 1.0f); }

}  // namespace

/// A surface in one instant.
struct Renderer::Seen {
  Eigen::Matrix3f to_plane = Eigen::Matrix3f::Zero();  ///< a ray (x, y, 1) to (u, v, 1) over its depth
  const Texture* texture = nullptr;
  int left = 0, right = -1, top = 0, bottom = -1;  ///< pixels that it may cover, ends included
  bool fine = false;
  float gloss = 0;
  Eigen::Vector3f normal, lamp;  ///< in camera coordinates
  Eigen::Vector3f corner, u_edge, v_edge;
};

/// The row being composed, front to back.
struct Renderer::Row {
  std::vector<Pixel4> colour;  ///< premultiplied; the fourth is the coverage
  std::vector<char> full;      ///< of each chunk: nothing more is seen through it
  const float* x = nullptr;    ///< the rays of its pixels
  const float* y = nullptr;
};

Renderer::Renderer(const Scene& scene, const Camera& camera)
    : scene_(scene), camera_(camera), fine_(scene.surfaces.size(), false) {
  check_camera(camera);
  for (const HungTarget& target : scene.targets) fine_[target.surface] = true;
  const auto [width, height] = camera.picture;
  padded_ = (width + kChunk - 1) / kChunk * kChunk;
  rays_x_.reserve(static_cast<std::size_t>(padded_) * static_cast<std::size_t>(height));
  rays_y_.reserve(rays_x_.capacity());
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < padded_; ++x) {
      const Eigen::Vector2d ray =
          normalised(camera, {static_cast<double>(std::min(x, width - 1)), static_cast<double>(y)});
      rays_x_.push_back(static_cast<float>(ray.x()));
      rays_y_.push_back(static_cast<float>(ray.y()));
    }
}

Renderer::Seen Renderer::see(const Surface& surface, std::size_t index, const Pose& pose, double t) const {
  Seen seen;
  const Eigen::Matrix3d to_camera = pose.rotation.conjugate().toRotationMatrix();
  const Eigen::Vector3d corner = to_camera * (surface.corner_at(t) - pose.position);
  const Eigen::Vector3d right = to_camera * surface.right, down = to_camera * surface.down;
  const Eigen::Vector3d normal = right.cross(down);
  if (normal.dot(corner) <= 1e-9) return seen;  // seen from behind, or along its plane
  Eigen::Matrix3d from_plane;
  from_plane << right, down, corner;
  seen.to_plane = from_plane.inverse().cast<float>();
  seen.texture = surface.texture.get();
  seen.fine = fine_[index];
  seen.gloss = static_cast<float>(surface.gloss);
  if (surface.gloss > 0) {
    seen.normal = -normal.normalized().cast<float>();
    seen.lamp = pose.to_camera(scene_.lamp).cast<float>();
    seen.corner = corner.cast<float>(), seen.u_edge = right.cast<float>(), seen.v_edge = down.cast<float>();
  }

  set_bounds(seen, corner, right, down);
  return seen;
}

/// The pixels that a rectangle in camera coordinates may cover.
void Renderer::set_bounds(Seen& seen, const Eigen::Vector3d& corner, const Eigen::Vector3d& right,
                          const Eigen::Vector3d& down) const {
  // The edges, looked at in many places: a lens bends them, and some may be behind the camera.
  constexpr int kPlaces = 12;
  double left = 1e9, top = 1e9, bottom = -1e9, rightmost = -1e9;
  bool whole = true;
  for (int side = 0; side < 4; ++side)
    for (int i = 0; i < kPlaces; ++i) {
      const double along = i / static_cast<double>(kPlaces);
      const double u = side == 0 ? along : side == 1 ? 1 : side == 2 ? 1 - along : 0;
      const double v = side == 0 ? 0 : side == 1 ? along : side == 2 ? 1 : 1 - along;
      const auto at = project(camera_, corner + u * right + v * down);
      if (!at) {
        whole = false;
        continue;
      }
      left = std::min(left, at->x), rightmost = std::max(rightmost, at->x);
      top = std::min(top, at->y), bottom = std::max(bottom, at->y);
    }
  const int width = camera_.picture.width, height = camera_.picture.height;
  if (!whole) left = top = -1e9, rightmost = bottom = 1e9;
  const double bend = camera_.k1 != 0 || camera_.k2 != 0 ? 0.02 * (rightmost - left + bottom - top) : 0;
  seen.left = static_cast<int>(std::clamp(std::floor(left - 1 - bend), 0.0, static_cast<double>(width)));
  seen.right = static_cast<int>(std::clamp(std::ceil(rightmost + 1 + bend), -1.0, width - 1.0));
  seen.top = static_cast<int>(std::clamp(std::floor(top - 1 - bend), 0.0, static_cast<double>(height)));
  seen.bottom = static_cast<int>(std::clamp(std::ceil(bottom + 1 + bend), -1.0, height - 1.0));
}

/// Front to back.
std::vector<Renderer::Seen> Renderer::seen_at(const Exposure& exposure, double t) const {
  const Pose pose = exposure.pose(t);
  std::vector<Seen> all;
  for (std::size_t i = scene_.surfaces.size(); i-- > 0;) {
    const Seen seen = see(scene_.surfaces[i], i, pose, t);
    if (seen.left <= seen.right && seen.top <= seen.bottom) all.push_back(seen);
  }
  return all;
}

/// How a surface is sampled in a short piece of a row: a level of its texture whose texels are about as large as what a
/// sample stands for.
struct Renderer::Footprint {
  const float* texels;
  std::ptrdiff_t stride;  ///< floats from a row to the next
  float columns, rows;
  int last_column, last_row;  ///< of the left and upper texel of four
  float u_edge, v_edge;       ///< pixels in a unit of u and of v
};

Renderer::Footprint Renderer::footprint_of(const Seen& seen, float x, float y) const {
  const auto per_pixel = static_cast<float>(1 / camera_.focal_px);
  const Eigen::Matrix3f& m = seen.to_plane;
  const Eigen::Vector3f at = m * Eigen::Vector3f(x, y, 1);
  const float depth = std::max(at.z(), 1e-6f), scale = per_pixel / depth, u = at.x() / depth,
              v = at.y() / depth;
  const float ux = (m(0, 0) - u * m(2, 0)) * scale, uy = (m(0, 1) - u * m(2, 1)) * scale;
  const float vx = (m(1, 0) - v * m(2, 0)) * scale, vy = (m(1, 1) - v * m(2, 1)) * scale;
  const auto& levels = seen.texture->levels;
  const float width2 = static_cast<float>(levels[0].cols) * static_cast<float>(levels[0].cols);
  const float height2 = static_cast<float>(levels[0].rows) * static_cast<float>(levels[0].rows);
  const float across2 = ux * ux * width2 + vx * vx * height2, down2 = uy * uy * width2 + vy * vy * height2;
  const float texels2 = std::max(across2, down2) * (seen.fine ? 0.25f : 1.0f);
  // Half the binary logarithm, rounded: of a square, twice it is the exponent.
  int exponent = 0;
  std::frexp(2 * std::max(texels2, 1e-12f), &exponent);
  const auto index = std::clamp((exponent - 1) >> 1, 0, static_cast<int>(levels.size()) - 1);
  const cv::Mat& level = levels[static_cast<std::size_t>(index)];
  return {level.ptr<float>(),
          static_cast<std::ptrdiff_t>(level.step1()),
          static_cast<float>(level.cols),
          static_cast<float>(level.rows),
          std::max(0, level.cols - 2),
          std::max(0, level.rows - 2),
          1 / std::sqrt(std::max(ux * ux + uy * uy, 1e-18f)),
          1 / std::sqrt(std::max(vx * vx + vy * vy, 1e-18f))};
}

/// The texture at a place in [0, 1]^2, between its texels.
inline Pixel4 Renderer::texel_at(const Footprint& f, float u, float v) {
  const float x = std::clamp(u * f.columns - 0.5f, 0.0f, f.columns - 1);
  const float y = std::clamp(v * f.rows - 0.5f, 0.0f, f.rows - 1);
  const int left = std::min(static_cast<int>(x), f.last_column),
            top = std::min(static_cast<int>(y), f.last_row);
  const float fx = x - static_cast<float>(left), fy = y - static_cast<float>(top);
  const float* upper = f.texels + top * f.stride + 4 * left;
  const float* lower = f.rows > 1 ? upper + f.stride : upper;
  const int next = f.columns > 1 ? 4 : 0;
  const Pixel4 a = load(upper), b = load(upper + next), c = load(lower), d = load(lower + next);
  const Pixel4 up = a + fx * (b - a), down = c + fx * (d - c);
  return up + fy * (down - up);
}

/// What is seen of a surface at (u, v): premultiplied, the fourth is the coverage.
inline Pixel4 Renderer::seen_at_place(const Seen& seen, const Footprint& footprint, float u, float v) {
  const float covered = clamp01(0.5f + std::min(u, 1 - u) * footprint.u_edge) *
                        clamp01(0.5f + std::min(v, 1 - v) * footprint.v_edge);
  if (covered <= 0) return Pixel4{0, 0, 0, 0};
  Pixel4 texel = texel_at(footprint, u, v);
  if (seen.gloss > 0) {
    const float spot =
        seen.gloss * texel[3] * mirrored(seen, seen.corner + u * seen.u_edge + v * seen.v_edge);
    texel += Pixel4{spot, spot, spot, 0};
  }
  return covered * texel;
}

/// How much of the lamp a point of a glossy surface mirrors: Blinn's half vector.
float Renderer::mirrored(const Seen& seen, const Eigen::Vector3f& point) {
  const Eigen::Vector3f half = (seen.lamp - point).normalized() - point.normalized();
  return std::pow(std::max(half.normalized().dot(seen.normal), 0.0f), 200.0f);
}

/// The mean of four places within the pixel.
Pixel4 Renderer::seen_finely(const Seen& seen, const Footprint& footprint, float x, float y) const {
  const auto aside = static_cast<float>(0.25 / camera_.focal_px);
  const Eigen::Matrix3f& m = seen.to_plane;
  Pixel4 sum{0, 0, 0, 0};
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3f at =
        m * Eigen::Vector3f(x + (i & 1 ? aside : -aside), y + (i & 2 ? aside : -aside), 1);
    if (at.z() > 0) sum += seen_at_place(seen, footprint, at.x() / at.z(), at.y() / at.z());
  }
  return 0.25f * sum;
}

/// Where a chunk's rays meet a surface's plane.
struct Renderer::Places {
  float u[kChunk], v[kChunk], depth[kChunk];  ///< depth: its inverse; not positive where the plane is behind

  Places(const Eigen::Matrix3f& m, const float* x, const float* y) {
    for (int i = 0; i < kChunk; ++i) {
      depth[i] = m(2, 0) * x[i] + m(2, 1) * y[i] + m(2, 2);
      u[i] = (m(0, 0) * x[i] + m(0, 1) * y[i] + m(0, 2)) / depth[i];
      v[i] = (m(1, 0) * x[i] + m(1, 1) * y[i] + m(1, 2)) / depth[i];
    }
  }
  /// Along a row u and v only rise or only fall, so the ends tell; with a margin of two pixels for edges and lenses.
  bool miss() const {
    constexpr int last = kChunk - 1;
    if (depth[0] <= 0 && depth[last] <= 0) return true;
    if (depth[0] <= 0 || depth[last] <= 0) return false;
    return outside(u[0], u[last]) || outside(v[0], v[last]);
  }
  /// Whether all pixels see the plane from about as far.
  bool alike() const {
    const float a = depth[0], b = depth[kChunk - 1];
    return a > 0 && b > 0 && std::max(a, b) < 1.2f * std::min(a, b);
  }
  /// Whether pixel i is on the surface or a tenth of it beside it.
  bool near(int i) const {
    return depth[i] > 0 && u[i] > -0.1f && u[i] < 1.1f && v[i] > -0.1f && v[i] < 1.1f;
  }

 private:
  static bool outside(float a, float b) {
    const float margin = std::abs(a - b) / 8 + 0.01f;
    return std::max(a, b) < -margin || std::min(a, b) > 1 + margin;
  }
};

void Renderer::draw_row(const Seen& seen, Row& row) const {
  for (int begin = seen.left / kChunk * kChunk; begin <= seen.right; begin += kChunk) {
    char& full = row.full[static_cast<std::size_t>(begin / kChunk)];
    if (full) continue;
    const float *x = row.x + begin, *y = row.y + begin;
    const Places places(seen.to_plane, x, y);
    if (places.miss()) continue;
    // Each pixel has a footprint of its own on sheets, against which truth is held, and on what is seen edge-on.
    const bool alike = !seen.fine && places.alike();
    Footprint footprint = footprint_of(seen, x[kChunk / 2], y[kChunk / 2]);
    full = 1;
    for (int i = 0; i < kChunk; ++i) {
      Pixel4& colour = row.colour[static_cast<std::size_t>(begin + i)];
      if (colour[3] >= kOpaque) continue;
      if (places.depth[i] > 0 && (alike || places.near(i))) {
        if (!alike) footprint = footprint_of(seen, x[i], y[i]);
        colour += (1 - colour[3]) * (seen.fine ? seen_finely(seen, footprint, x[i], y[i])
                                               : seen_at_place(seen, footprint, places.u[i], places.v[i]));
      }
      if (colour[3] < kOpaque) full = 0;
    }
  }
}

void Renderer::add_step(const Exposure& exposure, double t, cv::Mat& sum) const {
  const int width = camera_.picture.width, height = camera_.picture.height;
  Row row;
  row.colour.resize(static_cast<std::size_t>(padded_));
  row.full.resize(static_cast<std::size_t>(padded_ / kChunk));
  std::vector<Seen> seen = seen_at(exposure, t);
  double seen_for = 0;
  for (int y = 0; y < height; ++y) {
    const double delay = exposure.delay_s(y, height);
    if (exposure.rolling() && (y == 0 || std::abs(delay - seen_for) > 20e-6)) {
      seen = seen_at(exposure, t + delay);  // a row or some, never 0.02 ms apart
      seen_for = delay;
    }
    std::fill(row.colour.begin(), row.colour.end(), Pixel4{0, 0, 0, 0});
    std::fill(row.full.begin(), row.full.end(), 0);
    const std::size_t first = static_cast<std::size_t>(padded_) * static_cast<std::size_t>(y);
    row.x = rays_x_.data() + first, row.y = rays_y_.data() + first;
    for (const Seen& surface : seen)
      if (y >= surface.top && y <= surface.bottom) draw_row(surface, row);
    float* out = sum.ptr<float>(y);
    for (std::size_t x = 0; x < static_cast<std::size_t>(width); ++x, out += 3) {
      // Where two walls meet, each covers a part of the pixel: what is missing is more of the same.
      const Pixel4 colour = row.colour[x] / std::max(row.colour[x][3], 1e-3f);
      out[0] += colour[0], out[1] += colour[1], out[2] += colour[2];
    }
  }
}

int Renderer::steps_for(double motion_px, const ExposurePlan& plan) {
  if (motion_px < 1e-3) return 1;
  const double wanted = std::max(2.0, std::ceil(motion_px / plan.step_px));
  return static_cast<int>(std::min(wanted, static_cast<double>(plan.most_steps)));
}

void Renderer::render(const Exposure& exposure, int steps, cv::Mat& light) const {
  light.create(camera_.picture.height, camera_.picture.width, CV_32FC3);
  light.setTo(cv::Scalar::all(0));
  for (int i = 0; i < steps; ++i)
    add_step(exposure, exposure.begin_s() + (i + 0.5) / steps * exposure.duration_s(), light);
  if (steps > 1) light.convertTo(light, -1, 1.0 / steps);
}

std::optional<Eigen::Vector3d> Renderer::first_hit(const Pose& pose, double t, Vec2 pixel) const {
  const Eigen::Vector2d place = normalised(camera_, pixel);
  const Eigen::Vector3d ray = pose.rotation * Eigen::Vector3d(place.x(), place.y(), 1);
  for (std::size_t i = scene_.surfaces.size(); i-- > 0;)
    if (const auto depth = scene_.surfaces[i].hit(pose.position, ray, t)) return pose.position + *depth * ray;
  return {};
}

double Renderer::motion_px(const Exposure& exposure) const {
  constexpr int kAcross = 5, kDown = 4, kTimes = 8;
  std::vector<std::pair<Eigen::Vector3d, const Surface*>> points;
  const Pose middle = exposure.pose(exposure.middle_s());
  for (int j = 0; j < kDown; ++j)
    for (int i = 0; i < kAcross; ++i)
      if (const auto hit = first_hit(middle, exposure.middle_s(),
                                     {i * (camera_.picture.width - 1.0) / (kAcross - 1),
                                      j * (camera_.picture.height - 1.0) / (kDown - 1)}))
        points.emplace_back(*hit, nullptr);
  for (const HungTarget& target : scene_.targets) {
    const Surface& sheet = scene_.surfaces[target.surface];
    points.emplace_back(sheet.corner + 0.5 * (sheet.right + sheet.down), nullptr);
  }
  for (const Surface& surface : scene_.surfaces)
    if (surface.shift) points.emplace_back(surface.corner + 0.5 * (surface.right + surface.down), &surface);

  const double reach = std::hypot(camera_.picture.width, camera_.picture.height);
  double most = 0;
  for (const auto& [point, moving] : points) {
    double way = 0;
    std::optional<Vec2> before;
    for (int i = 0; i <= kTimes; ++i) {
      const double t = exposure.begin_s() + exposure.duration_s() * i / kTimes;
      const Eigen::Vector3d world = moving ? point + moving->shift(t) : point;
      const auto at = project(camera_, exposure.pose(t).to_camera(world));
      if (at && norm(*at - camera_.middle()) > reach) continue;  // not seen
      if (at && before) way += norm(*at - *before);
      before = at;
    }
    most = std::max(most, way);
  }
  return most;
}

}  // namespace relock::simulator
