#include "sequences/simulator/scene.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "core/random.h"
#include "tests/sequences/scratch.h"

namespace relock::simulator {
namespace {

using Eigen::Vector3d;

constexpr double kDiameter = 0.15;

std::vector<PrintedTarget> targets(std::size_t count, int texels = 64) {
  std::vector<PrintedTarget> made(count);
  for (std::size_t i = 0; i < count; ++i) {
    made[i].name = "ring:0" + std::to_string(i);
    made[i].size_m = kDiameter;
    made[i].picture = cv::Mat(texels, texels, CV_8UC1, cv::Scalar(255));
  }
  return made;
}

Vector3d middle(const Surface& s) { return s.corner + 0.5 * (s.right + s.down); }
Vector3d away(const Surface& s) { return s.right.cross(s.down).normalized(); }

// Where on a surface a ray from its visible side meets it, as shares of right and down.
std::optional<Eigen::Vector2d> meets(const Vector3d& eye, const Vector3d& ray, const Surface& s,
                                     double t = 0) {
  const Vector3d normal = s.right.cross(s.down);
  const Vector3d corner = s.shift ? Vector3d(s.corner + s.shift(t)) : s.corner;
  if (ray.dot(normal) <= 0) return {};
  const double far = (corner - eye).dot(normal) / ray.dot(normal);
  if (far <= 0) return {};
  const Vector3d place = eye + far * ray - corner;
  const Eigen::Vector2d share{place.dot(s.right) / s.right.squaredNorm(),
                              place.dot(s.down) / s.down.squaredNorm()};
  if (share.minCoeff() < 0 || share.maxCoeff() >= 1) return {};
  return share;
}

cv::Vec4f texel(const Surface& s, const Eigen::Vector2d& share) {
  const cv::Mat& full = s.texture->levels.front();
  return full.at<cv::Vec4f>(static_cast<int>(share.y() * full.rows), static_cast<int>(share.x() * full.cols));
}

TEST(Scene, OfOneSeedIsTheSameAgainAndOfAnotherIsAnother) {
  const ScenePlan plan{.occluders_hz = 0.5};
  const Scene a = build_scene(plan, targets(2), 7), b = build_scene(plan, targets(2), 7);
  ASSERT_EQ(a.surfaces.size(), b.surfaces.size());
  for (std::size_t i = 0; i < a.surfaces.size(); ++i) {
    const cv::Mat& x = a.surfaces[i].texture->levels.front();
    const cv::Mat& y = b.surfaces[i].texture->levels.front();
    EXPECT_EQ(a.surfaces[i].corner, b.surfaces[i].corner);
    ASSERT_EQ(x.size(), y.size());
    EXPECT_EQ(std::memcmp(x.data, y.data, x.total() * x.elemSize()), 0) << i;
    if (a.surfaces[i].shift) {
      EXPECT_EQ(a.surfaces[i].shift(12.3), b.surfaces[i].shift(12.3));
    }
  }
  const Scene other = build_scene(plan, targets(2), 8);
  const cv::Mat& wall = a.surfaces.front().texture->levels.front();
  EXPECT_GT(cv::norm(wall, other.surfaces.front().texture->levels.front()), 0);
}

TEST(Scene, HangsTheMainTargetInTheOriginFacingTheCameraAndOthersAround) {
  const std::vector<std::pair<Arrangement, std::vector<Vector3d>>> expected = {
      {Arrangement::wall, {{0, 0, 0}, {0.4, 0, 0}, {0, 0.4, 0}, {0.4, 0.4, 0}}},
      {Arrangement::wall, {{0, 0, 0}, {0.4, 0, 0}, {-0.4, 0, 0}}},
      {Arrangement::paper, {{0, 0, 0}, {-0.4, 0, 0}, {0.4, 0, 0}}}};
  for (const auto& [arrangement, places] : expected) {
    const ScenePlan plan{.arrangement = arrangement, .spacing_m = 0.4, .clutter = 0};
    const Scene scene = build_scene(plan, targets(places.size()), 1);
    ASSERT_EQ(scene.targets.size(), places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Surface& sheet = scene.surfaces[scene.targets[i].surface];
      EXPECT_LT((middle(sheet) - places[i]).norm(), 1e-9);
      EXPECT_LT((away(sheet) - Vector3d::UnitZ()).norm(), 1e-9);
      EXPECT_NEAR(sheet.right.norm(), 0.2, 1e-12);
      EXPECT_NEAR(sheet.down.y(), 0.2, 1e-12);
    }
  }
}

TEST(Scene, HangsOneTargetOutwardOnEachSideOfTheBox) {
  const Scene scene =
      build_scene({.arrangement = Arrangement::box, .box_side_m = 0.5, .clutter = 0}, targets(4), 1);
  const Vector3d axis{0, 0, 0.25};
  const Vector3d outward[] = {-Vector3d::UnitZ(), Vector3d::UnitX(), Vector3d::UnitZ(), -Vector3d::UnitX()};
  for (std::size_t i = 0; i < 4; ++i) {
    const Surface& sheet = scene.surfaces[scene.targets[i].surface];
    EXPECT_LT((middle(sheet) - (axis + 0.25 * outward[i])).norm(), 1e-9);
    EXPECT_LT((away(sheet) + outward[i]).norm(), 1e-9);
    EXPECT_NEAR(sheet.down.y(), 0.2, 1e-12);
  }
}

// What the painter's order shows must be what is nearest, from wherever the camera may be.
TEST(Scene, DrawsWhatIsNearerLater) {
  for (const Arrangement arrangement : {Arrangement::wall, Arrangement::box}) {
    const Scene scene = build_scene({.arrangement = arrangement}, targets(4), 3);
    Random random(11);
    for (int i = 0; i < 4000; ++i) {
      const double turn = 2 * M_PI * random.uniform(), far = 0.6 + 1.9 * random.uniform();
      const double depth = arrangement == Arrangement::box ? far * std::cos(turn) + 0.225 : -far;
      const Vector3d eye{far * std::sin(turn), 2.4 * random.uniform() - 1.3, depth};
      const Vector3d aim{2 * random.uniform() - 1, 2.4 * random.uniform() - 1.1, 0.225};
      double last = 1e9;
      for (const Surface& s : scene.surfaces)
        if (meets(eye, aim - eye, s)) {
          const double distance = (s.corner - eye).dot(away(s)) / (aim - eye).dot(away(s));
          EXPECT_LE(distance, last + 1e-9);
          last = distance;
        }
    }
  }
}

TEST(Scene, LetsNoClutterHangBeforeASheet) {
  const Scene scene = build_scene({.spacing_m = 0.3, .clutter = 1}, targets(4), 5);
  const double wall = 0.001;
  int posters = 0;
  for (const Surface& s : scene.surfaces) {
    const bool hangs =
        std::abs(s.corner.z() - wall) < 1e-6 && std::abs(s.right.z()) < 1e-6 && std::abs(s.down.z()) < 1e-6;
    if (!hangs || s.right.norm() > 0.8) continue;  // wider: the wall itself
    ++posters;
    for (const HungTarget& target : scene.targets) {
      const Surface& sheet = scene.surfaces[target.surface];
      for (int i = 0; i <= 400; ++i) {
        const Vector3d place = sheet.corner + (i % 21) / 20.0 * sheet.right + (i / 21) / 20.0 * sheet.down;
        EXPECT_FALSE(meets(place - Vector3d::UnitZ(), Vector3d::UnitZ(), s));
      }
    }
  }
  EXPECT_GT(posters, 15);
}

TEST(Scene, HasBareWallsWithoutClutter) {
  EXPECT_EQ(build_scene({.clutter = 0}, targets(1), 5).surfaces.size(), 6u + 1u + 1u);
}

TEST(Scene, IsAClosedRoom) {
  for (const Arrangement arrangement : {Arrangement::wall, Arrangement::box}) {
    const Scene scene = build_scene({.arrangement = arrangement, .clutter = 0}, targets(1), 2);
    Random random(3);
    const auto signed_unit = [&] { return 2 * random.uniform() - 1; };
    for (int i = 0; i < 5000; ++i) {
      const double depth =
          arrangement == Arrangement::box ? 2.7 * signed_unit() : -0.3 - 4 * random.uniform();
      const Vector3d eye{2.7 * signed_unit(), 1.2 * signed_unit(), depth};
      const Vector3d ray{signed_unit(), signed_unit(), signed_unit()};
      EXPECT_TRUE(std::any_of(scene.surfaces.begin(), scene.surfaces.begin() + 7,
                              [&](const Surface& s) { return meets(eye, ray, s).has_value(); }))
          << eye.transpose() << " along " << ray.transpose();
    }
  }
}

TEST(Scene, ShowsWhitePaperInEvenLightAtFourFifths) {
  const Scene scene = build_scene({.clutter = 0, .light_gradient = 0, .shadows = 0}, targets(1), 2);
  cv::Scalar mean, spread;
  cv::meanStdDev(scene.surfaces[scene.targets[0].surface].texture->levels.front(), mean, spread);
  EXPECT_NEAR(mean[1], 0.8, 0.02);
  EXPECT_LT(spread[1], 1e-5);
}

TEST(Scene, LightsASheetAsTheWallAroundIt) {
  const Scratch scratch;
  const std::string white = (scratch.path() / "white.png").string();
  cv::imwrite(white, cv::Mat(900, 2000, CV_8UC3, cv::Scalar::all(255)));
  const Scene scene =
      build_scene({.clutter = 0, .background = white, .light_gradient = 1, .shadows = 1}, targets(4, 512), 9);
  for (const HungTarget& target : scene.targets) {
    const Surface& sheet = scene.surfaces[target.surface];
    const Surface& wall = scene.surfaces[5];
    double apart = 0;  // on average: shadows have edges, finer than either's light
    for (double share = 0.05; share < 1; share += 0.1) {
      const Vector3d place = sheet.corner + 0.05 * sheet.right + share * sheet.down;
      const auto on_wall = meets(place - Vector3d::UnitZ(), Vector3d::UnitZ(), wall);
      ASSERT_TRUE(on_wall);
      apart += std::abs(texel(sheet, {0.05, share})[1] / 0.85 - texel(wall, *on_wall)[1]) / 10;
    }
    EXPECT_LT(apart, 0.025) << target.id;
  }
}

TEST(Scene, IsDarkestFarFromTheLampWhenLightFallsToNone) {
  const Scene scene = build_scene({.clutter = 0, .light_gradient = 1, .shadows = 0}, targets(1), 9);
  const auto brightness = [&](std::size_t wall) {
    return cv::mean(scene.surfaces[wall].texture->levels.back())[1];
  };
  EXPECT_LT(brightness(3), 0.02);  // left
  EXPECT_GT(brightness(4), 0.05);  // right
}

TEST(Scene, KeepsItsTexturesUnderTwoHundredMegabytes) {
  for (const Arrangement arrangement : {Arrangement::wall, Arrangement::box}) {
    const Scene scene =
        build_scene({.arrangement = arrangement, .clutter = 1, .occluders_hz = 1}, targets(4, 1200), 1);
    std::vector<const Texture*> textures;
    for (const Surface& s : scene.surfaces) textures.push_back(s.texture.get());
    std::sort(textures.begin(), textures.end());
    textures.erase(std::unique(textures.begin(), textures.end()), textures.end());
    double bytes = 0;
    for (const Texture* texture : textures)
      for (const cv::Mat& level : texture->levels)
        bytes += static_cast<double>(level.total() * level.elemSize());
    EXPECT_LT(bytes, 200e6);
  }
}

TEST(Scene, NamesASecondTargetOfOneNameApart) {
  std::vector<PrintedTarget> twins = targets(2);
  twins[1].name = twins[0].name;
  const Scene scene = build_scene({.clutter = 0}, twins, 1);
  EXPECT_EQ(scene.targets[0].id, "ring:00");
  EXPECT_EQ(scene.targets[1].id, "ring:00-2");
}

// How much of a target a camera straight before it does not see.
double hidden(const Scene& scene, const Surface& sheet, double t) {
  const Vector3d facing = -away(sheet), eye = middle(sheet) + 1.2 * facing;
  int covered = 0;
  for (int i = 0; i < 49; ++i) {
    const double x = (i % 7 - 3) / 6.0 * kDiameter, y = (i / 7 - 3) / 6.0 * kDiameter;
    const Vector3d place = middle(sheet) + x * sheet.right.normalized() + y * sheet.down.normalized();
    covered += std::any_of(scene.occluders.begin(), scene.occluders.end(), [&](std::size_t index) {
      const auto at = meets(eye, place - eye, scene.surfaces[index], t);
      return at && texel(scene.surfaces[index], *at)[3] > 0.5f;
    });
  }
  return covered / 49.0;
}

TEST(Occluders, HideEachTargetWhollyAndInPartButSeldomAndNotInTheFirstSecond) {
  const Scene scene =
      build_scene({.arrangement = Arrangement::box, .clutter = 0, .occluders_hz = 0.5}, targets(2), 4);
  for (const HungTarget& target : scene.targets) {
    double most = 0, sum = 0;
    int in_part = 0, count = 0;
    for (double t = 0; t < 80; t += 0.04, ++count) {
      const double now = hidden(scene, scene.surfaces[target.surface], t);
      most = std::max(most, now);
      sum += now;
      in_part += now > 0.2 && now < 0.8;
      EXPECT_TRUE(t >= 1 || now == 0) << t;
    }
    EXPECT_EQ(most, 1);
    EXPECT_GT(in_part, 20);
    EXPECT_LT(sum / count, 0.4);
    EXPECT_GT(sum / count, 0.02);
  }
}

TEST(Occluders, MoveWithoutJumps) {
  const Scene scene = build_scene({.clutter = 0, .occluders_hz = 3}, targets(1), 4);
  constexpr double kStep = 1e-3, kFastest = 20;  // s, m/s
  for (const std::size_t index : scene.occluders) {
    const auto& shift = scene.surfaces[index].shift;
    Vector3d before = shift(0);
    for (double t = kStep; t < 30; t += kStep) {
      const Vector3d now = shift(t);
      ASSERT_LT((now - before).norm(), kFastest * kStep) << t;
      before = now;
    }
  }
}

TEST(Occluders, PassAsOftenAsAsked) {
  for (const double hz : {0.1, 0.5, 2.0}) {
    const Scene scene = build_scene({.clutter = 0, .occluders_hz = hz}, targets(1), 6);
    int passes = 0;
    for (const std::size_t index : scene.occluders) {
      bool was_near = false;
      for (double t = 0; t < 200; t += 0.02) {
        const bool near = scene.surfaces[index].shift(t).norm() < 1;
        passes += near && !was_near;
        was_near = near;
      }
    }
    EXPECT_NEAR(passes, 200 * hz, 3 + 2 * hz);
  }
}

TEST(Scene, SaysWhatIsWrongWithAPlan) {
  const auto fault = [](const ScenePlan& plan, std::size_t count) {
    return fault_of([&] { build_scene(plan, targets(count), 1); });
  };
  const auto has = [](const std::string& sentence, const std::string& part) {
    return sentence.find(part) != std::string::npos;
  };
  EXPECT_TRUE(has(fault({}, 0), "at least one target"));
  EXPECT_TRUE(has(fault({.arrangement = Arrangement::box}, 5), "the box has places for 4"));
  EXPECT_TRUE(has(fault({.arrangement = Arrangement::paper}, 4), "has places for 3"));
  EXPECT_TRUE(has(fault({.spacing_m = 0.1}, 2), "overlap"));
  EXPECT_TRUE(has(fault({.spacing_m = 2}, 5), "do not all fit"));
  EXPECT_TRUE(has(fault({.arrangement = Arrangement::box, .box_side_m = 0.15}, 1), "does not fit on a box"));
  EXPECT_TRUE(has(fault({.clutter = std::nan("")}, 1), "clutter"));
  EXPECT_TRUE(has(fault({.background = "/nowhere.png"}, 1), "/nowhere.png"));
  const Scratch scratch;
  scratch.write("words.png", "not a picture");
  EXPECT_TRUE(has(fault({.background = scratch.path() / "words.png"}, 1), "no picture"));
}

}  // namespace
}  // namespace relock::simulator
