#include "detectors/pose/pose.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/random.h"
#include "tests/fault.h"

namespace relock::pose {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180, kSize = 0.15;

Camera straight_camera() { return {{640, 480}, 576, 576, 319.5, 239.5, {}}; }
Camera bent_camera() { return {{640, 480}, 570, 580, 310, 245, {-0.12, 0.03, 0.001, -0.0005, 0}}; }

/// A target that is tilted by `tilt` about an axis in the picture at `azimuth`, then turned in its own plane.
struct Hung {
  Vector3d position;
  Eigen::Quaterniond rotation;
  Vector3d normal() const { return rotation * -Vector3d::UnitZ(); }
};
Hung hung(const Vector3d& position, double tilt_deg, double azimuth_deg, double turn_deg = 0) {
  const Vector3d axis(std::cos(azimuth_deg * kDegree), std::sin(azimuth_deg * kDegree), 0);
  return {position, Eigen::AngleAxisd(tilt_deg * kDegree, axis) *
                        Eigen::AngleAxisd(turn_deg * kDegree, Vector3d::UnitZ())};
}

Vec2 seen(const Camera& camera, const Hung& target, const Vector2d& on_plane) {
  return project(camera, target.position + target.rotation * Vector3d(on_plane.x(), on_plane.y(), 0));
}

/// The image of the circle, exact without distortion: from five points of it.
Ellipse image_of_circle(const Camera& camera, const Hung& target, double radius) {
  // The homography from pixels to the plane, as the ring detector's view has it, gives the ellipse in closed form.
  Eigen::Matrix3d k, h;
  k << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1;
  const Eigen::Matrix3d r = target.rotation.toRotationMatrix();
  h << r.col(0) * radius, r.col(1) * radius, target.position;
  const Eigen::Matrix3d from_picture = (k * h).inverse();
  const Eigen::Matrix3d conic = from_picture.transpose() * Vector3d(1, 1, -1).asDiagonal() * from_picture;
  const Eigen::Matrix2d q = conic.topLeftCorner<2, 2>();
  const Vector2d centre = -q.inverse() * conic.topRightCorner<2, 1>();
  const double level = -(centre.dot(conic.topRightCorner<2, 1>()) + conic(2, 2));
  const Eigen::Matrix2d m = q / level;
  const double mean = 0.5 * m.trace(), apart = std::hypot(0.5 * (m(0, 0) - m(1, 1)), m(0, 1));
  const double angle = 0.5 * std::atan2(2 * m(0, 1), m(0, 0) - m(1, 1)) + std::numbers::pi / 2;
  return {{centre.x(), centre.y()},
          1 / std::sqrt(mean - apart),
          1 / std::sqrt(mean + apart),
          std::fmod(angle + std::numbers::pi, std::numbers::pi)};
}

Sighting ring_sighting(const Camera& camera, const Hung& target) {
  return {.centre = seen(camera, target, {0, 0}),
          .centre_kind = CentreKind::projected,
          .outline = image_of_circle(camera, target, kSize / 2)};
}
Sighting square_sighting(const Camera& camera, const Hung& target) {
  const double h = kSize / 2;
  return sighting_of(Quad{{seen(camera, target, {-h, -h}), seen(camera, target, {h, -h}),
                           seen(camera, target, {h, h}), seen(camera, target, {-h, h})}});
}

double between_deg(const Vector3d& a, const Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) / kDegree;
}

const std::array kHung{hung({0, 0, 0.6}, 30, 20, 40), hung({0.1, -0.05, 0.8}, 55, 130, 200),
                       hung({-0.2, 0.1, 1.2}, 12, 250, 90)};

TEST(CirclePose, OfAProjectedCircleIsThePoseItHad) {
  for (const Hung& target : kHung) {
    const auto poses = pose_of_circle(straight_camera(), ring_sighting(straight_camera(), target), kSize);
    ASSERT_FALSE(poses.empty());
    EXPECT_LT((poses[0].position - target.position).norm(), 1e-5);
    EXPECT_LT(between_deg(poses[0].normal, target.normal()), 0.01);
    EXPECT_FALSE(poses[0].rotation);
    EXPECT_GT(poses[0].probability, 0.99);
  }
}

TEST(CirclePose, HasTwoSolutionsWhereOnlyTheOutlineIsKnown) {
  const Hung target = kHung[1];
  Sighting sighting = ring_sighting(straight_camera(), target);
  sighting.centre_kind = CentreKind::outline;
  sighting.centre = centre_of(sighting.outline);
  const auto poses = pose_of_circle(straight_camera(), sighting, kSize);
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_NEAR(poses[0].probability, 0.5, 0.01);
  EXPECT_LT(
      std::min(between_deg(poses[0].normal, target.normal()), between_deg(poses[1].normal, target.normal())),
      0.01);
  for (const Pose& pose : poses) EXPECT_LT(pose.misfit, 1e-6);
}

TEST(CirclePose, ScalesWithTheMarker) {
  const Sighting sighting = ring_sighting(straight_camera(), kHung[0]);
  const auto one = pose_of_circle(straight_camera(), sighting, kSize),
             two = pose_of_circle(straight_camera(), sighting, 2 * kSize);
  EXPECT_LT((2 * one[0].position - two[0].position).norm(), 1e-6);
  EXPECT_LT(between_deg(one[0].normal, two[0].normal), 1e-4);
}

TEST(CirclePose, SaysHowFarItMayBeOff) {
  const Hung target = kHung[0];
  Random random(3);
  double squared = 0, normal = 0;
  const int trials = 150;
  const double deviation = 0.1;
  for (int trial = 0; trial < trials; ++trial) {
    Sighting sighting = ring_sighting(straight_camera(), target);
    sighting.centre = sighting.centre + deviation * Vec2{random.normal(), random.normal()};
    auto& e = std::get<Ellipse>(sighting.outline);
    e.centre = e.centre + deviation * Vec2{random.normal(), random.normal()};
    e.semi_major += deviation * random.normal(), e.semi_minor += deviation * random.normal();
    const Pose pose = pose_of_circle(straight_camera(), sighting, kSize, {deviation, deviation}).front();
    const Vector3d off = pose.position - target.position;
    squared += off.dot(pose.covariance.topLeftCorner<3, 3>().inverse() * off) / trials;
    normal += std::pow(between_deg(pose.normal, target.normal()) * kDegree / pose.normal_deviation_rad(), 2) /
              trials;
  }
  // Chi-squared of three degrees of freedom; an ellipse's five numbers stand for points along it, so within a factor.
  EXPECT_GT(squared, 1);
  EXPECT_LT(squared, 6);
  EXPECT_GT(normal, 0.2);
  EXPECT_LT(normal, 4);
}

TEST(SquarePose, OfAProjectedSquareIsThePoseItHad) {
  for (const Camera& camera : {straight_camera(), bent_camera()})
    for (const Hung& target : kHung) {
      const auto poses = pose_of_square(camera, square_sighting(camera, target), kSize);
      ASSERT_FALSE(poses.empty());
      EXPECT_LT((poses[0].position - target.position).norm(), 1e-5);
      ASSERT_TRUE(poses[0].rotation);
      EXPECT_LT(poses[0].rotation->angularDistance(target.rotation), 1e-4);
    }
}

TEST(SquarePose, SaysHowFarItMayBeOff) {
  const Hung target = kHung[1];
  Random random(5);
  double squared = 0;
  const int trials = 150;
  for (int trial = 0; trial < trials; ++trial) {
    Sighting sighting = square_sighting(straight_camera(), target);
    for (Vec2& corner : std::get<Quad>(sighting.outline).corner)
      corner = corner + 0.1 * Vec2{random.normal(), random.normal()};
    const Pose pose = pose_of_square(straight_camera(), sighting, kSize, {0.1, 0.1}).front();
    Eigen::Matrix<double, 6, 1> off;
    const Eigen::AngleAxisd turn(*pose.rotation * target.rotation.inverse());
    off << pose.position - target.position, turn.angle() * turn.axis();
    squared += off.dot(pose.covariance.inverse() * off) / trials;
  }
  EXPECT_NEAR(squared, 6, 1.2);  // chi-squared of six degrees of freedom, over 150 trials: 6 +- .28
}

TEST(SquarePose, IsUncertainOfItsTiltFromAfar) {
  const Hung target = hung({0, 0, 12}, 15, 30);
  const auto poses = pose_of_square(straight_camera(), square_sighting(straight_camera(), target), kSize);
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_GT(poses[1].probability, 0.05);
}

TEST(PlatePose, FollowsFromFourMarkersInKnownPlaces) {
  const std::vector<Placed> plate{{{"ring2", "00"}, {-0.2, -0.2}},
                                  {{"ring2", "01"}, {0.2, -0.2}},
                                  {{"ring2", "10"}, {0.2, 0.2}},
                                  {{"ring2", "11"}, {-0.2, 0.25}}};
  for (const Hung& target : kHung) {
    Sightings sightings;
    for (const Placed& marker : plate) {
      Sighting s = sighting_of(Box{0, 0, 10, 10});
      s.centre = seen(bent_camera(), target, marker.middle_m);
      s.code = marker.code;
      sightings.insert(sightings.begin(), s);  // in whatever order
    }
    const auto poses = pose_of_plate(bent_camera(), sightings, plate);
    ASSERT_FALSE(poses.empty());
    EXPECT_LT((poses[0].position - target.position).norm(), 1e-5);
    EXPECT_LT(poses[0].rotation->angularDistance(target.rotation), 1e-4);
    sightings.pop_back();
    EXPECT_TRUE(pose_of_plate(bent_camera(), sightings, plate).empty());
  }
}

TEST(PlatePose, NeedsMarkersThatDoNotLieOnALine) {
  std::vector<Placed> plate;
  Sightings sightings;
  for (int i = 0; i < 5; ++i) {
    plate.push_back({{"ring3", std::to_string(i)}, {0.1 * i, 0.05 * i}});
    Sighting s = sighting_of(Box{0, 0, 10, 10});
    s.centre = seen(straight_camera(), kHung[0], plate.back().middle_m), s.code = plate.back().code;
    sightings.push_back(s);
  }
  EXPECT_TRUE(pose_of_plate(straight_camera(), sightings, plate).empty());
}

TEST(PoseCamera, SeesWhatItProjects) {
  const Vector3d point(0.2, -0.15, 0.9);
  const Vector2d normal = normalised(bent_camera(), project(bent_camera(), point));
  EXPECT_NEAR(normal.x(), point.x() / point.z(), 1e-7);
  EXPECT_NEAR(normal.y(), point.y() / point.z(), 1e-7);
}

TEST(Pose, RefusesWhatHasNone) {
  const Sighting box = sighting_of(Box{10, 10, 20, 20}), ring = ring_sighting(straight_camera(), kHung[0]);
  EXPECT_TRUE(pose_of(straight_camera(), box, kSize).empty());
  EXPECT_NE(fault_of([&] { pose_of_circle(straight_camera(), box, kSize); }).find("ellipse"),
            std::string::npos);
  EXPECT_NE(fault_of([&] { pose_of_circle(straight_camera(), ring, 0); }).find("above 0 m"),
            std::string::npos);
  EXPECT_NE(fault_of([&] { pose_of_square(straight_camera(), ring, kSize); }).find("four corners"),
            std::string::npos);
  Camera none = straight_camera();
  none.fx = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(fault_of([&] { pose_of(none, ring, kSize); }).find("focal lengths"), std::string::npos);
}

}  // namespace
}  // namespace relock::pose
