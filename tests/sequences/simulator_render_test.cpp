// Rendered light agrees with the truth that is told of it.

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include <gtest/gtest.h>

#include "core/error.h"
#include "sequences/simulator/flight_truth.h"
#include "sequences/simulator/render.h"

namespace relock::simulator {
namespace {

constexpr double kDisc_m = 0.15, kSheet_m = 0.2;

/// A white disc on a black sheet, before black.
PrintedTarget disc() {
  PrintedTarget printed{
      .name = "disc", .outline = PrintedOutline::circle, .size_m = kDisc_m, .sheet_m = kSheet_m};
  constexpr int kSide = 1024, kFiner = 4;
  cv::Mat large(kSide * kFiner, kSide * kFiner, CV_8UC1, cv::Scalar(0));
  const double radius = kDisc_m / kSheet_m / 2 * kSide * kFiner;
  for (int y = 0; y < large.rows; ++y)
    for (int x = 0; x < large.cols; ++x)
      if (std::hypot(x + 0.5 - large.cols / 2.0, y + 0.5 - large.rows / 2.0) < radius)
        large.at<std::uint8_t>(y, x) = 255;
  cv::resize(large, printed.picture, {kSide, kSide}, 0, 0, cv::INTER_AREA);
  return printed;
}

std::shared_ptr<const Texture> texture_of(const cv::Mat& picture) {
  return std::make_shared<const Texture>(make_texture(picture));
}

/// The disc, `aside_m` away from the middle, turned about the vertical by `turn_deg`.
Scene scene_of_disc(double turn_deg = 0, double aside_m = 0) {
  static const PrintedTarget printed = disc();
  static const auto sheet = texture_of(printed.picture),
                    black = texture_of(cv::Mat(4, 4, CV_8UC1, cv::Scalar(0)));
  Scene scene;
  scene.surfaces.push_back(
      {.corner = {-20, -20, 5}, .right = {40, 0, 0}, .down = {0, 40, 0}, .texture = black});
  const double turn = turn_deg * std::numbers::pi / 180;
  const Eigen::Vector3d right(kSheet_m * std::cos(turn), 0, kSheet_m * std::sin(turn)), down(0, kSheet_m, 0);
  const Eigen::Vector3d corner = Eigen::Vector3d(aside_m, 0, 0) - (right + down) / 2;
  scene.surfaces.push_back({.corner = corner, .right = right, .down = down, .texture = sheet});
  scene.targets.push_back({printed, "disc", 1});
  return scene;
}

MotionPlan still() {
  MotionPlan plan;
  plan.drift_m = plan.sway_deg = plan.vibration_deg = plan.steps_hz = plan.strokes_hz = 0;
  return plan;
}

/// Flies along the wall: fastest in the middle, at t = 0.
MotionPlan gliding(double m_per_s) {
  MotionPlan plan = still();
  plan.path = Path::fly_past;
  plan.sweep_m = 1;
  plan.path_period_s = 2 * std::numbers::pi / m_per_s;
  return plan;
}

Vec2 centroid(const cv::Mat& light) {
  double sum = 0, x_sum = 0, y_sum = 0;
  for (int y = 0; y < light.rows; ++y)
    for (int x = 0; x < light.cols; ++x) {
      const double value = light.at<cv::Vec3f>(y, x)[1];
      sum += value, x_sum += value * x, y_sum += value * y;
    }
  return {x_sum / sum, y_sum / sum};
}

struct Shown {
  cv::Mat light;
  FlightTruth truth;
  int steps;
};

Shown show(const Scene& scene, const Camera& camera, const MotionPlan& motion, const ExposurePlan& plan,
           double t = 0) {
  const Exposure exposure(plan, Motion(motion, 1), t, 0);
  const Renderer renderer(scene, camera);
  Shown shown;
  shown.steps = Renderer::steps_for(renderer.motion_px(exposure), plan);
  renderer.render(exposure, shown.steps, shown.light);
  shown.truth = truth_of_frame(scene, camera, exposure, shown.steps)[0];
  return shown;
}

double off_centre(const Shown& shown) {
  return norm(centroid(shown.light) - shown.truth.label.centre(CentreKind::outline));
}

Camera distorted() {
  Camera camera;
  camera.k1 = -0.15, camera.k2 = 0.02;
  return camera;
}

TEST(Renderer, PutsASharpDiscWhereTheTruthSays) {
  for (const Camera& camera : {Camera{}, distorted()})
    for (const double turn : {0.0, 45.0, 70.0})
      for (const double aside : {0.0, 0.31, -0.6}) {
        MotionPlan motion = still();
        motion.distance_m = 1;
        const Shown shown = show(scene_of_disc(turn, aside), camera, motion, {});
        EXPECT_EQ(shown.steps, 1);
        EXPECT_LT(off_centre(shown), 0.03) << "turned " << turn << " aside " << aside << " k1 " << camera.k1;
      }
}

MotionPlan looking_about() {
  MotionPlan plan = still();
  plan.distance_m = 1;
  plan.sway_deg = 5, plan.sway_hz = 6;
  return plan;
}

/// What instants within the exposure say: the mean centre, and the mean weighted by area, which is where the light is.
struct Instants {
  Vec2 mean, of_light;
};

Instants instants_of(const Scene& scene, const Camera& camera, const MotionPlan& motion,
                     const ExposurePlan& plan, double t) {
  constexpr int kInstants = 64;
  ExposurePlan brief = plan;
  brief.time_ms = 1e-3;
  Instants sum;
  double area = 0;
  for (int i = 0; i < kInstants; ++i) {
    const double at = t + ((i + 0.5) / kInstants - 0.5) * plan.time_ms / 1000;
    const Exposure exposure(brief, Motion(motion, 1), at, 0);
    const auto ellipse = std::get<Ellipse>(*truth_of_frame(scene, camera, exposure, 1)[0].label.outline);
    const double weight = ellipse.semi_major * ellipse.semi_minor;
    area += weight;
    sum.of_light = sum.of_light + weight * ellipse.centre;
    sum.mean = sum.mean + (1.0 / kInstants) * ellipse.centre;
  }
  sum.of_light = (1 / area) * sum.of_light;
  return sum;
}

TEST(Renderer, PutsABlurredDiscWhereTheTruthSays) {
  ExposurePlan plan;
  plan.time_ms = 32;
  double longest = 0;
  for (Camera camera : {Camera{}, distorted()})
    for (const double turn : {0.0, 60.0})
      for (const double t : {0.35, 1.7, 3.1}) {
        camera.picture = {320, 240};  // a part of it is enough, and quicker
        const Scene scene = scene_of_disc(turn);
        const Shown shown = show(scene, camera, looking_about(), plan, t);
        const Instants instants = instants_of(scene, camera, looking_about(), plan, t);
        longest = std::max(longest, norm(*shown.truth.label.blur));
        EXPECT_LT(norm(shown.truth.label.centre(CentreKind::outline) - instants.mean), 0.03);
        EXPECT_LT(norm(centroid(shown.light) - instants.of_light), 0.1)
            << "turned " << turn << " k1 " << camera.k1 << " blur " << norm(*shown.truth.label.blur);
      }
  EXPECT_GT(longest, 50);
}

TEST(Renderer, PutsADiscWhereTheTruthSaysThroughARollingShutter) {
  MotionPlan motion = gliding(2);
  motion.distance_m = 1;
  ExposurePlan plan;
  plan.readout_ms = 25;
  EXPECT_LT(off_centre(show(scene_of_disc(20, 0.1), {}, motion, plan)), 0.1);
}

TEST(Renderer, SmearsAsTheLabelledVectorSays) {
  // The variance that motion adds to the disc's own is that of a line: length^2 / 12.
  const auto spread_along = [](const cv::Mat& light, Vec2 unit) {
    const Vec2 middle = centroid(light);
    double sum = 0, spread = 0;
    for (int y = 0; y < light.rows; ++y)
      for (int x = 0; x < light.cols; ++x) {
        const double value = light.at<cv::Vec3f>(y, x)[1], along = dot(Vec2{x * 1.0, y * 1.0} - middle, unit);
        sum += value, spread += value * along * along;
      }
    return spread / sum;
  };
  MotionPlan motion = gliding(3);
  motion.distance_m = 1.5;
  ExposurePlan plan;
  plan.time_ms = 30;
  plan.step_px = 0.5;
  Camera camera;
  camera.picture = {240, 160};
  const Scene scene = scene_of_disc();
  const Shown blurred = show(scene, camera, motion, plan);
  const Shown sharp = show(
      scene, camera,
      [] {
        MotionPlan p = still();
        p.distance_m = 1.5;
        return p;
      }(),
      plan);
  const Vec2 blur = *blurred.truth.label.blur;
  const Vec2 along = (1 / norm(blur)) * blur, across{-along.y, along.x};
  const double length =
      std::sqrt(12 * (spread_along(blurred.light, along) - spread_along(sharp.light, along)));
  EXPECT_NEAR(length / norm(blur), 1, 0.02);
  EXPECT_NEAR(spread_along(blurred.light, across), spread_along(sharp.light, across), 0.05);
  EXPECT_NEAR(std::atan2(blur.y, -blur.x) * 180 / std::numbers::pi, 0,
              1);  // the camera goes right, the disc left
}

TEST(Renderer, GivesTheSharpPictureBitForBitWhenNothingMoves) {
  MotionPlan motion = still();
  motion.distance_m = 1;
  const Scene scene = scene_of_disc(30);
  ExposurePlan brief, slow;
  brief.time_ms = 0.01, slow.time_ms = 33;
  const Shown a = show(scene, {}, motion, brief), b = show(scene, {}, motion, slow, 7.3);
  EXPECT_EQ(cv::norm(a.light, b.light, cv::NORM_INF), 0);
}

TEST(Camera, ProjectionAndItsInverseAgree) {
  const Camera camera = distorted();
  for (const Vec2 pixel : {Vec2{0, 0}, {639, 359}, {320, 180}, {12.5, 300}}) {
    const Eigen::Vector2d place = normalised(camera, pixel);
    const auto back = project(camera, {3 * place.x(), 3 * place.y(), 3});
    ASSERT_TRUE(back);
    EXPECT_LT(norm(*back - pixel), 1e-6);
  }
}

TEST(Camera, SeesNothingThatIsBehindIt) { EXPECT_FALSE(project(Camera{}, {0, 0, -1})); }

TEST(Camera, RefusesALensThatFoldsThePicture) {
  Camera camera;
  camera.k1 = -2;
  EXPECT_THROW(check_camera(camera), Error);
}

TEST(Motion, IsContinuousAndAsFastAsItsLimits) {
  MotionPlan plan = still();
  plan.steps_hz = 2, plan.step_deg = 30, plan.step_s = 0.2, plan.strokes_hz = 1, plan.stroke_deg = 40;
  plan.most_rate_deg_s = 120;
  const Motion motion(plan, 3);
  double fastest = 0;
  for (double t = 0; t < 20; t += 1e-3) {
    const double turned = motion.at(t).rotation.angularDistance(motion.at(t + 1e-3).rotation);
    fastest = std::max(fastest, turned * 1e3 * 180 / std::numbers::pi);
  }
  // A step and a stroke of each of two axes at once.
  EXPECT_LT(fastest, 2 * std::sqrt(2) * 120 * 1.05);
  EXPECT_GT(fastest, 40);
}

TEST(Motion, HasTheRmsThatThePlanStates) {
  MotionPlan plan = still();
  plan.drift_m = 0.1, plan.drift_hz = 0.5;
  double sum = 0;
  int count = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed)
    for (double t = 0; t < 40; t += 0.5, ++count) {
      const double x = Motion(plan, seed).at(t).position.x();
      sum += x * x;
    }
  EXPECT_NEAR(std::sqrt(sum / count), 0.1, 0.005);
}

TEST(FlightTruth, TellsOfATargetThatIsSeenFromBehind) {
  MotionPlan motion = still();
  motion.distance_m = 1;
  const Shown shown = show(scene_of_disc(180), {}, motion, {});
  EXPECT_EQ(shown.truth.label.label, Label::absent);
  EXPECT_FALSE(shown.truth.in_front);
}

TEST(FlightTruth, TellsTiltDistanceAndSize) {
  MotionPlan motion = still();
  motion.distance_m = 2;
  const FlightTruth truth = show(scene_of_disc(50), {}, motion, {}).truth;
  EXPECT_NEAR(*truth.label.tilt_deg, 50, 1e-6);
  EXPECT_NEAR(truth.translation_m.z(), 2, 1e-9);
  EXPECT_NEAR(truth.label.size_px(), kDisc_m / 2 * Camera{}.focal_px, 0.2);
}

TEST(FlightTruth, TellsWhatAnOccluderHides) {
  Scene scene = scene_of_disc();
  Surface& back = scene.surfaces[0];
  scene.surfaces.push_back(
      {.corner = {0, -1, -0.3}, .right = {1, 0, 0}, .down = {0, 2, 0}, .texture = back.texture});
  scene.occluders.push_back(2);
  MotionPlan motion = still();
  motion.distance_m = 1;
  const FlightTruth truth = show(scene, {}, motion, {}).truth;
  EXPECT_NEAR(truth.label.occluded_fraction, 0.5, 0.03);
  EXPECT_NEAR(truth.label.visible_fraction, 0.5, 0.03);
}

}  // namespace
}  // namespace relock::simulator
