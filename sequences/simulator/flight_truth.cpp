#include "sequences/simulator/flight_truth.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace relock::simulator {
namespace {

using Eigen::Vector3d;

/// A target's sheet in the world.
struct Sheet {
  Vector3d middle, right, down;  ///< unit vectors
  double size_m;
  PrintedOutline outline;
  Vector3d normal() const { return right.cross(down); }  ///< away from who sees it
  Vector3d at(double x, double y) const { return middle + x * right + y * down; }
};

Sheet sheet_of(const Scene& scene, const HungTarget& target, double t) {
  const Surface& s = scene.surfaces[target.surface];
  return {s.corner_at(t) + 0.5 * (s.right + s.down), s.right.normalized(), s.down.normalized(),
          target.printed.size_m, target.printed.outline};
}

/// Where a point of the world is seen while the shutter is open at time t of its row.
class View {
 public:
  View(const Camera& camera, const Exposure& exposure) : camera_(camera), exposure_(exposure) {}

  std::optional<Vec2> seen(const Vector3d& world, double t) const {
    auto at = project(camera_, exposure_.pose(t).to_camera(world));
    if (!exposure_.rolling()) return at;
    // Which row sees it depends on where it is seen: the readout is slow, so this settles at once.
    for (int i = 0; i < 4 && at; ++i) at = project(camera_, exposure_.pose(t + delay(*at)).to_camera(world));
    return at;
  }

 private:
  double delay(Vec2 at) const {
    return exposure_.delay_s(std::clamp(at.y, 0.0, camera_.picture.height - 1.0), camera_.picture.height);
  }
  const Camera& camera_;
  const Exposure& exposure_;
};

/// Area, centroid and central second moments of a polygon (Green's theorem).
struct Moments {
  double area = 0, xx = 0, xy = 0, yy = 0;
  Vec2 centre;
};

Moments moments_of(const std::vector<Vec2>& polygon) {
  Moments m;
  const Vec2 origin = polygon.front();  // keeps the numbers small
  double cx = 0, cy = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 p = polygon[i] - origin, q = polygon[(i + 1) % polygon.size()] - origin;
    const double cross = p.x * q.y - q.x * p.y;
    m.area += cross / 2;
    cx += (p.x + q.x) * cross / 6, cy += (p.y + q.y) * cross / 6;
    m.xx += (p.x * p.x + p.x * q.x + q.x * q.x) * cross / 12;
    m.yy += (p.y * p.y + p.y * q.y + q.y * q.y) * cross / 12;
    m.xy += (p.x * q.y + 2 * p.x * p.y + 2 * q.x * q.y + q.x * p.y) * cross / 24;
  }
  const Vec2 mean{cx / m.area, cy / m.area};
  m.xx = m.xx / m.area - mean.x * mean.x, m.yy = m.yy / m.area - mean.y * mean.y;
  m.xy = m.xy / m.area - mean.x * mean.y;
  m.centre = origin + mean;
  return m;
}

/// The ellipse of the same centroid and second moments.
Ellipse ellipse_of(const Moments& m) {
  const double mean = (m.xx + m.yy) / 2, half = std::hypot((m.xx - m.yy) / 2, m.xy);
  double angle = 0.5 * std::atan2(2 * m.xy, m.xx - m.yy);
  if (angle < 0) angle += std::numbers::pi;
  if (angle >= std::numbers::pi) angle = 0;
  return {m.centre, 2 * std::sqrt(mean + half), 2 * std::sqrt(std::max(mean - half, 0.0)), angle};
}

constexpr int kPoints = 96;  // of a circle

/// The outline's points in one instant; empty when not all of them are seen.
std::vector<Vec2> outline_points(const Sheet& sheet, const View& view, double t) {
  std::vector<Vec2> points;
  const double half = sheet.size_m / 2;
  const auto add = [&](double x, double y) {
    const auto at = view.seen(sheet.at(x, y), t);
    if (at) points.push_back(*at);
    return at.has_value();
  };
  if (sheet.outline == PrintedOutline::square) {
    for (const auto [x, y] : {Vec2{-half, -half}, {half, -half}, {half, half}, {-half, half}})
      if (!add(x, y)) return {};
    return points;
  }
  // Larger by so much that the polygon's second moments over its area are the circle's.
  const double step = 2 * std::numbers::pi / kPoints;
  const double radius = half * std::sqrt(3 / (2 + std::cos(step)));
  for (int i = 0; i < kPoints; ++i)
    if (!add(radius * std::cos(i * step), radius * std::sin(i * step))) return {};
  return points;
}

/// Means over the sub-exposures.
struct Mean {
  std::vector<Vec2> corners = std::vector<Vec2>(4);
  Moments moments;
  Vec2 projected;
  int count = 0;
};

void add(Mean& mean, const Sheet& sheet, const View& view, double t) {
  const auto points = outline_points(sheet, view, t);
  const auto centre = view.seen(sheet.middle, t);
  if (points.empty() || !centre) return;
  const Moments m = moments_of(points);
  if (sheet.outline == PrintedOutline::square)
    for (std::size_t i = 0; i < 4; ++i) mean.corners[i] = mean.corners[i] + points[i];
  mean.moments.xx += m.xx, mean.moments.xy += m.xy, mean.moments.yy += m.yy;
  mean.moments.centre = mean.moments.centre + m.centre;
  mean.projected = mean.projected + *centre;
  ++mean.count;
}

Outline outline_of(const Mean& mean, const Sheet& sheet) {
  const double share = 1.0 / mean.count;
  if (sheet.outline == PrintedOutline::square) {
    Quad quad;
    for (std::size_t i = 0; i < 4; ++i) quad.corner[i] = share * mean.corners[i];
    return quad;
  }
  Moments m = mean.moments;
  m.xx *= share, m.xy *= share, m.yy *= share, m.centre = share * m.centre;
  return ellipse_of(m);
}

std::optional<Vec2> outline_centre(const Sheet& sheet, const View& view, double t) {
  const auto points = outline_points(sheet, view, t);
  if (points.empty()) return {};
  return moments_of(points).centre;
}

/// Whether a thing that moves before targets hides a point of the world.
bool hidden(const Scene& scene, const Vector3d& eye, const Vector3d& point, double t) {
  return std::any_of(scene.occluders.begin(), scene.occluders.end(), [&](std::size_t index) {
    return scene.surfaces[index].hit(eye, point - eye, t).value_or(1) < 1 - 1e-6;
  });
}

struct Parts {
  double visible = 0, occluded = 0;
};

/// Parts of the outline's area at mid-exposure, by a grid of points on the sheet.
Parts parts_of(const Scene& scene, const Camera& camera, const Exposure& exposure, const Sheet& sheet) {
  constexpr int kGrid = 24;
  const View view(camera, exposure);
  const double t = exposure.middle_s();
  const Vector3d eye = exposure.pose(t).position;
  const Box picture = picture_box(camera.picture);
  int all = 0, visible = 0, occluded = 0;
  for (int j = 0; j < kGrid; ++j)
    for (int i = 0; i < kGrid; ++i) {
      const double x = (2 * i + 1.0) / kGrid - 1, y = (2 * j + 1.0) / kGrid - 1;
      if (sheet.outline == PrintedOutline::circle && x * x + y * y > 1) continue;
      ++all;
      const Vector3d point = sheet.at(x * sheet.size_m / 2, y * sheet.size_m / 2);
      const bool behind = hidden(scene, eye, point, t);
      if (behind) ++occluded;
      const auto at = view.seen(point, t);
      if (!behind && at && at->x >= picture.x && at->x <= picture.right() && at->y >= picture.y &&
          at->y <= picture.bottom())
        ++visible;
    }
  return {visible / static_cast<double>(all), occluded / static_cast<double>(all)};
}

double border_of(const Outline& outline, Size picture) {
  const Box box = bounds(outline), whole = picture_box(picture);
  return std::min(
      {box.x - whole.x, box.y - whole.y, whole.right() - box.right(), whole.bottom() - box.bottom()});
}

void set_pose(FlightTruth& truth, const Sheet& sheet, const Pose& pose) {
  truth.translation_m = pose.to_camera(sheet.middle);
  Eigen::Matrix3d axes;
  axes << sheet.right, sheet.down, sheet.normal();
  const Eigen::AngleAxisd turn(pose.rotation.conjugate().toRotationMatrix() * axes);
  truth.rotation_rad = turn.angle() * turn.axis();
}

FlightTruth truth_of(const Scene& scene, const Camera& camera, const Exposure& exposure, int steps,
                     const HungTarget& target) {
  FlightTruth truth;
  const View view(camera, exposure);
  const double t = exposure.middle_s();
  const Sheet sheet = sheet_of(scene, target, t);
  const Pose pose = exposure.pose(t);
  const Vector3d sight = (sheet.middle - pose.position).normalized();
  const double facing = sheet.normal().dot(sight);
  set_pose(truth, sheet, pose);
  truth.label.visible_fraction = 0;
  truth.label.label = Label::absent;

  Mean mean;
  for (int i = 0; i < steps; ++i)
    add(mean, sheet, view, exposure.begin_s() + (i + 0.5) / steps * exposure.duration_s());
  const auto middle = outline_centre(sheet, view, t), projected = view.seen(sheet.middle, t);
  const auto first = outline_centre(sheet, view, exposure.begin_s()),
             last = outline_centre(sheet, view, exposure.end_s());
  if (facing <= 0 || mean.count < steps || !middle || !projected || !first || !last) return truth;

  truth.in_front = true;
  truth.outline_middle = *middle, truth.projected_middle = *projected;
  const Outline outline = outline_of(mean, sheet);
  truth.border_px = border_of(outline, camera.picture);
  const Vec2 way = *last - *first;
  truth.label.blur = way;
  const Vec2 off = *middle - 0.5 * (*first + *last);
  if (norm(way) > 0) truth.bend_px = (way.x * off.y - way.y * off.x) / norm(way);
  truth.label.tilt_deg = std::acos(std::min(facing, 1.0)) * 180 / std::numbers::pi;
  const Parts parts = parts_of(scene, camera, exposure, sheet);
  truth.label.visible_fraction = parts.visible, truth.label.occluded_fraction = parts.occluded;
  if (parts.visible == 0) return truth;
  truth.label.outline = outline;
  truth.label.centre_projected = (1.0 / mean.count) * mean.projected;
  truth.label.label = parts.visible >= 0.5 ? Label::visible : Label::unlabelled;
  return truth;
}

}  // namespace

std::vector<FlightTruth> truth_of_frame(const Scene& scene, const Camera& camera, const Exposure& exposure,
                                        int steps) {
  std::vector<FlightTruth> all;
  for (const HungTarget& target : scene.targets)
    all.push_back(truth_of(scene, camera, exposure, steps, target));
  return all;
}

}  // namespace relock::simulator
