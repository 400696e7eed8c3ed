#include "sequences/simulator/stills.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>

#include "core/display_coding.h"
#include "core/error.h"
#include "core/random.h"
#include "sequences/simulator/album.h"
#include "sequences/simulator/jumble.h"
#include "sequences/simulator/sensor_noise.h"
#include "sequences/simulator/sheet.h"
#include "sequences/simulator/smear.h"

namespace relock::simulator {
namespace {

using std::numbers::pi;

constexpr int kFiner = 2;  // times as fine as the picture is what it is made from
enum Key : std::uint64_t { kShownKey = 1, kPoseKey, kToneKey, kBackdropKey, kBlurKey, kNoiseKey };

/// Grey levels as what is averaged: themselves, or light from 0 to 1.
Tones tones_of(BlurIn blur_in, double black, double white) {
  Tones tones{};
  for (std::size_t i = 0; i < tones.size(); ++i) {
    const double level = black + (white - black) * static_cast<double>(i) / 255;
    tones[i] = static_cast<float>(blur_in == BlurIn::light ? light_of_coded(level / 255) : level);
  }
  return tones;
}

/// The grey level of light, from a table: it is asked for every pixel.
class Coding {
 public:
  Coding() {
    for (std::size_t i = 0; i < kSteps + 2; ++i)
      table_[i] = static_cast<float>(255 * coded_of_light(std::min(static_cast<double>(i) / kSteps, 1.0)));
  }
  float level(float light) const {
    const float at = std::clamp(light, 0.0F, 1.0F) * kSteps;
    const auto i = static_cast<std::size_t>(at);
    return table_[i] + (at - static_cast<float>(i)) * (table_[i + 1] - table_[i]);
  }

 private:
  static constexpr std::size_t kSteps = 16384;
  std::array<float, kSteps + 2> table_{};
};

/// The part of the world that a still is made from: the picture and what a blur brings into it.
struct Frame {
  cv::Rect area;  ///< px, from the top left corner of the picture's first pixel
  int margin;     ///< of it around the picture, px

  Frame(Size picture, Vec2 blur) : margin((smear_margin(kFiner * blur) + kFiner - 1) / kFiner) {
    area = {-margin, -margin, picture.width + 2 * margin, picture.height + 2 * margin};
  }
  /// From pixels of the picture to those of the finer one over the area.
  Eigen::Matrix3d to_finer() const {
    Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
    matrix(0, 0) = matrix(1, 1) = kFiner;
    matrix(0, 2) = matrix(1, 2) = kFiner * (margin + 0.5) - 0.5;
    return matrix;
  }
};

cv::Mat1f backdrop_of(const StillPlan& plan, const Frame& frame, const Random& random) {
  const Tones tones = tones_of(plan.blur_in, 0, 255);
  cv::Mat1f made(frame.area.size() * kFiner);
  if (plan.backdrop == Backdrop::plain) {
    made.setTo(plan.blur_in == BlurIn::light ? light_of_coded(plan.grey / 255) : plan.grey);
    return made;
  }
  const cv::Mat1b levels = jumble(plan.picture, frame.area, kFiner, random);
  for (int y = 0; y < made.rows; ++y)
    std::transform(levels[y], levels[y] + made.cols, made[y],
                   [&](std::uint8_t level) { return tones[level]; });
  return made;
}

void code(cv::Mat1f& light) {
  static const Coding coding;
  for (float& value : light) value = coding.level(value);
}

cv::Mat1b noisy(const cv::Mat1f& levels, double deviation, const Random& random) {
  Noise noise(random);
  cv::Mat1b made(levels.size());
  const auto strength = static_cast<float>(deviation);
  std::array<float, 4> normal{};
  std::size_t used = 4;
  for (int y = 0; y < made.rows; ++y)
    for (int x = 0; x < made.cols; ++x, ++used) {
      if (used == 4 && deviation > 0) normal = noise.next();
      if (used == 4) used = 0;
      made(y, x) = cv::saturate_cast<std::uint8_t>(levels(y, x) + strength * normal[used]);
    }
  return made;
}

bool fits(const Outline& outline, Size picture) {
  const Box box = bounds(outline), whole = picture_box(picture);
  return box.x >= whole.x + kStillBorder_px && box.y >= whole.y + kStillBorder_px &&
         box.right() <= whole.right() - kStillBorder_px && box.bottom() <= whole.bottom() - kStillBorder_px;
}

double radians(double degrees) { return degrees * pi / 180; }

/// A pose of the plan's ranges at which all of the outline is in the picture. The place is drawn again until it is.
SheetPose drawn_pose(const StillPlan& plan, const PrintedTarget& target, Random random) {
  Hang hang{.place = {},
            .size_px = drawn(random, plan.size_px),
            .tilt_rad = radians(drawn(random, plan.tilt_deg)),
            .azimuth_rad = 2 * pi * random.uniform(),
            .turn_rad = radians(drawn(random, plan.turn_deg))};
  const double border =
      std::min({hang.size_px / 2 + kStillBorder_px, plan.picture.width / 2.0, plan.picture.height / 2.0}) -
      0.5;
  for (int tries = 0; tries < 200; ++tries) {
    hang.place = {drawn(random, {border, plan.picture.width - 1 - border}),
                  drawn(random, {border, plan.picture.height - 1 - border})};
    const SheetPose pose = pose_of(hang, target.size_m, plan.camera());
    if (fits(outline_of(target, pose, plan.camera()), plan.picture)) return pose;
  }
  throw Error(fmt::format("a still of {}x{} px has no room for {} of {:.0f} px", plan.picture.width,
                          plan.picture.height, target.name, hang.size_px));
}

TargetTruth truth_of(const StillPlan& plan, const PrintedTarget& target, const SheetPose& pose, Vec2 blur) {
  TargetTruth truth;
  truth.label = Label::visible;
  truth.outline = outline_of(target, pose, plan.camera());
  truth.centre_projected = project(plan.camera(), pose.position);
  truth.blur = blur;
  truth.tilt_deg = std::acos(std::min(1.0, pose.normal().dot(pose.position.normalized()))) * 180 / pi;
  return truth;
}

TargetTruth absent() {
  TargetTruth truth;
  truth.label = Label::absent;
  truth.visible_fraction = 0;
  return truth;
}

Vec2 blur_of(const StillPlan& plan, std::size_t rank, Random random) {
  const double turn = 2 * pi * random.uniform();
  return plan.blurs_px[rank % plan.blurs_px.size()] * Vec2{std::cos(turn), std::sin(turn)};
}

}  // namespace

void check_stills(const StillPlan& plan) {
  check_range("stills: width", plan.picture.width, 16, 8192);
  check_range("stills: height", plan.picture.height, 16, 8192);
  check_range("stills: focal_widths", plan.focal_widths, 0.1, 100);
  check_range("stills: shown", plan.shown, 0, 1);
  check_range("stills: size_px", plan.size_px, 1, std::min(plan.picture.width, plan.picture.height));
  check_range("stills: tilt_deg", plan.tilt_deg, 0, 89);
  check_range("stills: turn_deg", plan.turn_deg, -360, 360);
  if (plan.blurs_px.empty()) throw Error("stills: blurs_px needs a length at least; 0 is none");
  for (const double length : plan.blurs_px) check_range("stills: blurs_px", length, 0, 1000);
  check_range("stills: noise", plan.noise, 0, 255);
  check_range("stills: black", plan.black, 0, 255);
  check_range("stills: white", plan.white, 0, 255);
  check_range("stills: grey", plan.grey, 0, 255);
}

Still still(const StillPlan& plan, std::span<const PrintedTarget> targets, std::size_t rank,
            std::uint64_t seed) {
  const Random random = Random(seed).fork(rank);
  Still made;
  made.blur = blur_of(plan, rank, random.fork(kBlurKey));
  made.targets.assign(targets.size(), absent());
  const Frame frame(plan.picture, made.blur);
  cv::Mat1f finer = backdrop_of(plan, frame, random.fork(kBackdropKey));
  if (!targets.empty() && random.fork(kShownKey).chance(plan.shown)) {
    const std::size_t shown = rank / plan.blurs_px.size() % targets.size();
    const PrintedTarget& target = targets[shown];
    check_sheet(target);
    made.shown = shown;
    made.pose = drawn_pose(plan, target, random.fork(kPoseKey));
    made.targets[shown] = truth_of(plan, target, made.pose, made.blur);
    Random tone = random.fork(kToneKey);
    const double black = drawn(tone, plan.black), white = drawn(tone, plan.white);
    draw_sheet(target, frame.to_finer() * homography(made.pose, plan.camera()),
               tones_of(plan.blur_in, black, white), finer);
  }
  cv::Mat1f levels = smeared(finer, kFiner * made.blur, kFiner * frame.margin, kFiner);
  if (plan.blur_in == BlurIn::light) code(levels);
  Random noise = random.fork(kNoiseKey);
  made.noise = drawn(noise, plan.noise);
  made.pixels = noisy(levels, made.noise, noise.fork(1));
  return made;
}

void write_stills(const std::filesystem::path& folder, const StillPlan& plan,
                  std::span<const PrintedTarget> targets, std::size_t count, std::uint64_t seed,
                  const std::string& plan_text) {
  check_stills(plan);
  Album album{.picture = plan.picture,
              .pages = count,
              .plan_name = "stills.toml",
              .plan_text = plan_text,
              .calibration_text = calibration_text(plan.camera())};
  for (const PrintedTarget& target : targets) {
    check_sheet(target);
    for (const Target& other : album.targets)
      if (other.id == target.name) throw Error(fmt::format("stills: {} is asked for twice", target.name));
    album.targets.push_back({target.name, target.code, target.size_m});
  }
  album.page = [&](std::size_t rank) -> AlbumPage {
    const Still made = still(plan, targets, rank, seed);
    return {made.pixels, made.targets};
  };
  write_album(folder, album);
}

}  // namespace relock::simulator
