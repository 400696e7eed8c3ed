#include "sequences/simulator/light.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace relock::simulator {
namespace {

using Eigen::Vector3d;

constexpr double kLampRadius = 0.18;  // m, as it is painted; makes shadows soft

double smooth(double share) {
  const double t = std::clamp(share, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// Where two line pieces come nearest: the share along the first, and how near.
struct Approach {
  double share, distance;
};

Approach approach(const Vector3d& from, const Vector3d& to, const Vector3d& other_from,
                  const Vector3d& other_to) {
  const Vector3d a = to - from, b = other_to - other_from, between = from - other_from;
  const double aa = a.squaredNorm(), bb = b.squaredNorm(), ab = a.dot(b);
  const double across = aa * bb - ab * ab;
  double s =
      across > 1e-12 ? std::clamp((ab * b.dot(between) - bb * a.dot(between)) / across, 0.0, 1.0) : 0.5;
  const double t = std::clamp((ab * s + b.dot(between)) / bb, 0.0, 1.0);
  s = std::clamp((ab * t - a.dot(between)) / aa, 0.0, 1.0);
  return {s, (between + s * a - t * b).norm()};
}

Vector3d direction(Random& random) {
  const double z = 2 * random.uniform() - 1, turn = 2 * M_PI * random.uniform();
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(turn), r * std::sin(turn), z};
}

}  // namespace

Vector3d outward(const Surface& surface) { return -surface.right.cross(surface.down).normalized(); }

Light::Light(const ScenePlan& plan, const Room& room, const Vector3d& lamp, const std::vector<Vector3d>& lit,
             Random random)
    : gradient_(plan.light_gradient), shadows_(plan.shadows), room_(room), lamp_(lamp) {
  const auto stand = [&](const Vector3d& shadow, double longest) {
    const Vector3d middle = shadow + (0.12 + 0.35 * random.uniform()) * (lamp_ - shadow);
    const double reach = 0.03 + longest * random.uniform();
    const Vector3d half = reach * direction(random);
    rods_.push_back({middle - half, middle + half, 0.02 + 0.06 * random.uniform()});
  };
  for (const Vector3d& target : lit)
    for (int i = 0; i < 2; ++i) {
      const double aside = 0.06 + 0.3 * random.uniform();
      stand(target + aside * direction(random), 0.4);
    }
  for (int i = 0; i < 8; ++i) {
    const Vector3d share{random.uniform(), 0.3 + 0.7 * random.uniform(), i % 2 == 0 ? 1.0 : random.uniform()};
    stand(room.low + share.cwiseProduct(room.high - room.low), 0.6);
  }
}

double Light::let_through(const Vector3d& place) const {
  double passed = 1;
  for (const Rod& rod : rods_) {
    const Approach near = approach(place, lamp_, rod.from, rod.to);
    // So much of the lamp's disc is seen from the place beside the rod.
    const double disc = std::max(kLampRadius * near.share, 1e-3);
    passed *= smooth((near.distance - rod.radius + disc) / (2 * disc));
  }
  return passed;
}

double Light::corners(const Vector3d& place) const {
  constexpr double kOnTheWall = 0.02, kReach = 0.35, kTaken = 0.5;
  double left = 1;
  for (const Vector3d& away : {Vector3d(place - room_.low), Vector3d(room_.high - place)})
    for (int axis = 0; axis < 3; ++axis)
      if (away[axis] > kOnTheWall) left *= 1 - kTaken * shadows_ * std::exp(-away[axis] / kReach);
  return left;
}

double Light::at(const Vector3d& place, const Vector3d& facing) const {
  const Vector3d to_lamp = lamp_ - place;
  const double distance = to_lamp.norm();
  const double slant = std::max(0.0, facing.dot(to_lamp) / std::max(distance, 1e-6));
  // 5 m: half of the lamp's light comes back from ceiling and walls, so it falls slower than by the square.
  const double from_lamp = (0.45 + 0.55 * slant) * 1.35 / (1 + distance * distance / 25);
  const double across = (place.x() - room_.low.x()) / (lamp_.x() - room_.low.x());
  const double lit = 1 - gradient_ + gradient_ * std::min(from_lamp, 1.0) * std::clamp(across, 0.0, 1.0);
  const double shadow = shadows_ * std::min(1.0, 4 * slant) * (1 - let_through(place));
  return kFull * lit * (1 - shadow) * corners(place);
}

cv::Mat Light::over(const Surface& surface, double cell_m) const {
  const auto cells = [&](double length) {
    return std::max(2, static_cast<int>(std::lround(length / cell_m)));
  };
  const Vector3d facing = outward(surface);
  cv::Mat light(cells(surface.down.norm()), cells(surface.right.norm()), CV_32FC1);
  for (int y = 0; y < light.rows; ++y)
    for (int x = 0; x < light.cols; ++x) {
      const Vector3d place =
          surface.corner + (x + 0.5) / light.cols * surface.right + (y + 0.5) / light.rows * surface.down;
      light.at<float>(y, x) = static_cast<float>(at(place, facing));
    }
  return light;
}

}  // namespace relock::simulator
