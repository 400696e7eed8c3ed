#include "sequences/simulator/stills.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "core/blur.h"
#include "core/display_coding.h"
#include "core/opencv.h"
#include "sequences/open.h"
#include "sequences/simulator/jumble.h"
#include "sequences/simulator/sheet.h"
#include "sequences/simulator/smear.h"
#include "sequences/simulator/stills_plan.h"
#include "tests/sequences/printed.h"
#include "tests/sequences/scratch.h"

namespace relock::simulator {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;

/// A small picture of a target in full contrast on plain grey, without noise.
StillPlan bare() {
  StillPlan plan;
  plan.picture = {160, 130};
  plan.size_px = {40, 60};
  plan.tilt_deg = {0, 60};
  plan.noise = plan.black = {0, 0};
  plan.white = {255, 255};
  plan.backdrop = Backdrop::plain;
  return plan;
}

Still still_of(const StillPlan& plan, const PrintedTarget& target, std::size_t rank = 0,
               std::uint64_t seed = 1) {
  check_stills(plan);
  return still(plan, std::vector{target}, rank, seed);
}

/// What is seen at a point of the picture: the straightforward way, a ray to the sheet's plane and bilinear sampling.
class Reference {
 public:
  Reference(const StillPlan& plan, const PrintedTarget& target, const SheetPose& pose)
      : plan_(plan), target_(target), back_(homography(pose, plan.camera()).inverse()) {}

  double at(double x, double y) const {
    const Vector3d place = back_ * Vector3d(x, y, 1);
    const double side = target_.picture.cols, per_m = side / target_.sheet_m;
    const double u = place.x() / place.z() * per_m + side / 2 - 0.5,
                 v = place.y() / place.z() * per_m + side / 2 - 0.5;
    if (!(u >= -0.5 && v >= -0.5 && u < side - 0.5 && v < side - 0.5)) return plan_.grey;
    const double across = std::clamp(u, 0.0, side - 1), down = std::clamp(v, 0.0, side - 1);
    const int left = std::min(static_cast<int>(across), target_.picture.cols - 2),
              top = std::min(static_cast<int>(down), target_.picture.rows - 2);
    const cv::Mat1b sheet = target_.picture;
    const auto row = [&](int r) {
      return sheet(r, left) + (across - left) * (sheet(r, left + 1) - sheet(r, left));
    };
    return row(top) + (down - top) * (row(top + 1) - row(top));
  }

  /// The mean over a pixel and along a blur.
  double mean(int x, int y, Vec2 blur, int steps) const {
    constexpr int kPlaces = 10;
    double sum = 0;
    for (int step = 0; step < steps; ++step)
      for (int i = 0; i < kPlaces * kPlaces; ++i) {
        const double t = (step + 0.5) / steps - 0.5;
        sum += at(x + (i % kPlaces + 0.5) / kPlaces - 0.5 - t * blur.x,
                  y + (i / kPlaces + 0.5) / kPlaces - 0.5 - t * blur.y);
      }
    return sum / (kPlaces * kPlaces * steps);
  }

 private:
  const StillPlan& plan_;
  const PrintedTarget& target_;
  Matrix3d back_;
};

/// Centre of all that is unlike the grey around.
Vec2 centroid(const cv::Mat1b& picture, double grey) {
  double sum = 0, sum_x = 0, sum_y = 0;
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 0; x < picture.cols; ++x) {
      const double weight = grey - picture(y, x);
      sum += weight, sum_x += weight * x, sum_y += weight * y;
    }
  return {sum_x / sum, sum_y / sum};
}

TEST(Stills, AreTheSheetSeenAtThePoseWhenSharp) {
  for (const PrintedTarget& target : {disc(20, 200), quarters()})
    for (std::size_t rank = 0; rank < 3; ++rank) {
      const StillPlan plan = bare();
      const Still made = still_of(plan, target, rank);
      const Reference reference(plan, target, made.pose);
      const cv::Mat1b pixels = made.pixels;
      double squares = 0;
      for (int y = 0; y < pixels.rows; ++y)
        for (int x = 0; x < pixels.cols; ++x) {
          const double off = pixels(y, x) - reference.mean(x, y, {}, 1);
          ASSERT_LT(std::abs(off), 12) << x << " " << y;  // where an edge crosses, of up to 250 levels
          squares += off * off;
        }
      EXPECT_LT(std::sqrt(squares / static_cast<double>(pixels.total())), 0.35) << "rounding alone: 0.29";
    }
}

TEST(Stills, AreTheSheetSeenAtThePoseWhenSmallAndFlat) {
  StillPlan plan = bare();
  plan.size_px = {9, 16};
  plan.tilt_deg = {70, 80};
  for (std::size_t rank = 0; rank < 6; ++rank) {
    const PrintedTarget target = disc(0, 128);
    const Still made = still_of(plan, target, rank);
    const Reference reference(plan, target, made.pose);
    const Box box = bounds(*made.targets[0].outline);
    const cv::Mat1b pixels = made.pixels;
    for (int y = cvFloor(box.y) - 2; y <= cvCeil(box.bottom()) + 2; ++y)
      for (int x = cvFloor(box.x) - 2; x <= cvCeil(box.right()) + 2; ++x)
        ASSERT_NEAR(pixels(y, x), reference.mean(x, y, {}, 1), 6) << x << " " << y;
  }
}

TEST(Stills, AreTheMeanOfTheSheetMovingWhenBlurred) {
  for (const double length : {3.0, 25.0})
    for (std::size_t rank = 0; rank < 2; ++rank) {
      StillPlan plan = bare();
      plan.blurs_px = {length};
      const PrintedTarget target = quarters();
      const Still made = still_of(plan, target, rank, 5);
      const Reference reference(plan, target, made.pose);
      const cv::Mat1b pixels = made.pixels;
      for (int y = 2; y < pixels.rows; y += 5)
        for (int x = 1; x < pixels.cols; x += 5)
          ASSERT_NEAR(pixels(y, x), reference.mean(x, y, made.blur, 40), length > 10 ? 2 : 4)
              << x << " " << y;
    }
}

TEST(Stills, AreTheMeanOfTheSameStillShiftedClutterAndAll) {
  StillPlan sharp, blurred;
  sharp.noise = blurred.noise = {0, 0};
  sharp.picture = blurred.picture = {320, 240};
  blurred.blurs_px = {40};
  const Still before = still_of(sharp, disc(), 3, 8), after = still_of(blurred, disc(), 3, 8);
  EXPECT_EQ(before.pose.position, after.pose.position);
  cv::Mat1f expected, made;
  const double direction =
      std::fmod(std::atan2(after.blur.y, after.blur.x) + std::numbers::pi, std::numbers::pi);
  cv::filter2D(before.pixels, expected, CV_32F, blur_kernel({direction, 40}));
  after.pixels.convertTo(made, CV_32F);
  const cv::Rect inside(25, 25, 270, 190);
  const cv::Mat off = made(inside) - expected(inside);
  EXPECT_LT(cv::norm(off, cv::NORM_L2) / std::sqrt(static_cast<double>(inside.area())), 1.0);
  EXPECT_LT(cv::norm(off, cv::NORM_INF), 12);
}

TEST(Stills, HaveTheDiscsCentreWhereTheOutlineSays) {
  for (const double length : {0.0, 12.0})
    for (std::size_t rank = 0; rank < 8; ++rank) {
      StillPlan plan = bare();
      plan.blurs_px = {length};
      plan.picture = {200, 170};
      const Still made = still_of(plan, disc(20, 128), rank, 3);
      const Vec2 found = centroid(made.pixels, plan.grey);
      const Box smear = bounds(*made.targets[0].outline);
      if (smear.x < 9 || smear.y < 9 || smear.right() > 190 || smear.bottom() > 160) continue;  // part is cut
      EXPECT_LT(norm(found - centre_of(*made.targets[0].outline)), 0.005);
    }
}

TEST(Stills, HaveEdgesWhereTheEllipseSays) {
  StillPlan plan = bare();
  plan.tilt_deg = {70, 70};
  plan.size_px = {60, 60};
  for (std::size_t rank = 0; rank < 4; ++rank) {
    const Still made = still_of(plan, disc(0, 128), rank, 4);
    const auto ellipse = std::get<Ellipse>(*made.targets[0].outline);
    const cv::Mat1b pixels = made.pixels;
    for (int i = 0; i < 12; ++i) {
      // Over a short line across the edge, as many pixels' worth is dark as is inside.
      const double phi = i * std::numbers::pi / 6, c = std::cos(ellipse.angle_rad),
                   s = std::sin(ellipse.angle_rad);
      const Vec2 on{ellipse.semi_major * std::cos(phi), ellipse.semi_minor * std::sin(phi)},
          out{std::cos(phi) / ellipse.semi_major, std::sin(phi) / ellipse.semi_minor};
      const Vec2 edge = ellipse.centre + Vec2{c * on.x - s * on.y, s * on.x + c * on.y},
                 normal = (1 / norm(out)) * Vec2{c * out.x - s * out.y, s * out.x + c * out.y};
      double dark = 0;
      for (int k = -40; k < 40; ++k) {
        const Vec2 at = edge + ((k + 0.5) / 20) * normal;
        cv::Mat1f sample;
        cv::getRectSubPix(pixels, {1, 1}, cv::Point2f(static_cast<float>(at.x), static_cast<float>(at.y)),
                          sample, CV_32F);
        dark += (plan.grey - static_cast<double>(sample(0, 0))) / plan.grey / 20;
      }
      EXPECT_NEAR(dark, 2, 0.08) << "at " << phi;  // what is curved within the line moves it a little
    }
  }
}

TEST(Stills, StraightOnInTheMiddleAreTheCanvas) {
  const PrintedTarget target = quarters();
  const CanvasPlan canvas{
      .canvas_px = 160, .marker_px = 50.3, .lengths_px = {0}, .angles_deg = {0}, .noise = 0};
  const CanvasPicture expected = canvas_picture(canvas, target, 0, 2);
  const Camera camera{.picture = {160, 160}, .focal_px = 144};
  const SheetPose pose =
      pose_of({.place = *expected.truth.centre_projected, .size_px = 50.3}, target.size_m, camera);
  const auto outline = std::get<Quad>(outline_of(target, pose, camera)),
             quad = std::get<Quad>(*expected.truth.outline);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_LT(norm(outline.corner[i] - quad.corner[i]), 0.05);

  // As stills are drawn: twice as fine, with a margin of 3 px.
  Matrix3d finer = Matrix3d::Identity();
  finer(0, 0) = finer(1, 1) = 2, finer(0, 2) = finer(1, 2) = 6.5;
  Tones levels{};
  for (std::size_t i = 0; i < levels.size(); ++i) levels[i] = static_cast<float>(i);
  cv::Mat1f drawn(332, 332, static_cast<float>(canvas.grey));
  draw_sheet(target, finer * homography(pose, camera), levels, drawn);
  cv::Mat1f off;
  expected.pixels.convertTo(off, CV_32F);
  off -= smeared(drawn, {}, 6, 2);
  EXPECT_LT(cv::norm(off, cv::NORM_INF), 12) << "where an edge crosses, of up to 250 levels";
  EXPECT_LT(cv::norm(off, cv::NORM_L2) / 160, 0.4);
}

TEST(Stills, KeepToThePlan) {
  StillPlan plan;
  plan.picture = {320, 240};
  plan.size_px = {30, 70};
  plan.tilt_deg = {10, 55};
  plan.noise = {1, 4};
  plan.blurs_px = {0, 20};
  plan.backdrop = Backdrop::plain;
  double least = 1e9, most = 0, least_tilt = 90, most_tilt = 0, left = 0;
  for (std::size_t rank = 0; rank < 40; ++rank) {
    const Still made = still_of(plan, disc(), rank, 6);
    const TargetTruth& truth = made.targets[0];
    EXPECT_EQ(truth.label, Label::visible);
    least = std::min(least, truth.size_px()), most = std::max(most, truth.size_px());
    least_tilt = std::min(least_tilt, *truth.tilt_deg), most_tilt = std::max(most_tilt, *truth.tilt_deg);
    left += truth.centre(CentreKind::outline).x < 160 ? 1 : 0;
    EXPECT_NEAR(norm(*truth.blur), rank % 2 == 0 ? 0 : 20, 1e-9);
    EXPECT_GE(made.noise, 1);
    EXPECT_LE(made.noise, 4);
    EXPECT_NEAR(std::abs(made.pose.normal().dot(made.pose.position.normalized())),
                std::cos(*truth.tilt_deg * std::numbers::pi / 180), 1e-9);
    EXPECT_NEAR(share_inside(*truth.outline, picture_box(plan.picture)), 1, 1e-9);
  }
  EXPECT_GE(least, 30 - 1e-6);
  EXPECT_LE(most, 70 + 1e-6);
  EXPECT_GT(most - least, 30);
  EXPECT_GE(least_tilt, 10 - 1e-6);
  EXPECT_LE(most_tilt, 55 + 1e-6);
  EXPECT_GT(most_tilt - least_tilt, 30);
  EXPECT_GT(left, 8);
  EXPECT_LT(left, 32);
}

TEST(Stills, LeanAwayTowardsTheAzimuth) {
  const Camera camera{.picture = {641, 481}, .focal_px = 500};
  const SheetPose pose =
      pose_of({.place = {320, 240}, .size_px = 100, .tilt_rad = 0.8, .azimuth_rad = 0}, 0.1, camera);
  EXPECT_GT(pose.right.z(), 0.5) << "its right side is farther away";
  EXPECT_NEAR(pose.down.z(), 0, 1e-12);
  EXPECT_GT(pose.normal().z(), 0);
  const SheetPose turned = pose_of({.place = {320, 240}, .size_px = 100, .turn_rad = 0.3}, 0.1, camera);
  EXPECT_GT(turned.right.y(), 0.2) << "turned from +x towards +y";
}

TEST(Stills, HaveTwoCentresUnderPerspective) {
  StillPlan plan = bare();
  plan.tilt_deg = {60, 60};
  const TargetTruth truth = still_of(plan, disc()).targets[0];
  EXPECT_GT(norm(*truth.centre_projected - centre_of(*truth.outline)), 0.5);
  const TargetTruth square = still_of(plan, quarters()).targets[0];
  EXPECT_LT(norm(*square.centre_projected - diagonals_meet(std::get<Quad>(*square.outline))), 1e-9);
}

TEST(Stills, BlurLightOnlyWhenAsked) {
  StillPlan coded = bare();
  coded.blurs_px = {30};
  StillPlan light = coded;
  light.blur_in = BlurIn::light;
  const cv::Mat1b in_coded = still_of(coded, disc(0, 255)).pixels,
                  in_light = still_of(light, disc(0, 255)).pixels;
  EXPECT_GT(cv::mean(in_light)[0], cv::mean(in_coded)[0] + 2) << "what is half dark, half bright is brighter";
  EXPECT_EQ(in_coded(0, 0), 128);
  EXPECT_EQ(in_light(0, 0), 128);
}

TEST(Stills, HaveNoiseOfTheStatedDeviation) {
  StillPlan plan = bare();
  plan.noise = {6, 6};
  cv::Scalar mean, deviation;
  cv::meanStdDev(still(plan, {}, 0, 1).pixels, mean, deviation);
  EXPECT_NEAR(mean[0], 128, 0.2);
  EXPECT_NEAR(deviation[0], std::sqrt(36 + 1 / 12.0), 0.15);
}

TEST(Stills, WithoutATargetAreTheSameBackdrop) {
  StillPlan plan;
  plan.picture = {320, 240};
  plan.size_px = {40, 60};
  plan.noise = {0, 0};
  const Still with = still_of(plan, disc(), 7, 9), without = still(plan, {}, 7, 9);
  EXPECT_TRUE(without.targets.empty());
  EXPECT_FALSE(without.shown);
  plan.shown = 0;
  const Still absent = still_of(plan, disc(), 7, 9);
  EXPECT_EQ(absent.targets[0].label, Label::absent);
  EXPECT_EQ(cv::norm(absent.pixels, without.pixels, cv::NORM_INF), 0);
  // Where they differ is the sheet, and nowhere else.
  cv::Mat1b off;
  cv::absdiff(with.pixels, without.pixels, off);
  const Box box = bounds(*with.targets[0].outline);
  const cv::Rect outside_sheet = cv::boundingRect(off);
  EXPECT_LT(outside_sheet.width, 2.4 * box.width);
  EXPECT_GE(outside_sheet.x + outside_sheet.width, box.right() - 1);
}

TEST(Stills, HaveAnotherBackdropEach) {
  StillPlan plan;
  plan.picture = {160, 120};
  plan.size_px = {20, 30};
  const cv::Mat first = still(plan, {}, 0, 1).pixels;
  EXPECT_GT(cv::norm(first, still(plan, {}, 1, 1).pixels, cv::NORM_L1) / static_cast<double>(first.total()),
            10);
  EXPECT_GT(cv::norm(first, still(plan, {}, 0, 2).pixels, cv::NORM_L1) / static_cast<double>(first.total()),
            10);
  EXPECT_EQ(cv::norm(first, still(plan, {}, 0, 1).pixels, cv::NORM_INF), 0);
}

TEST(Stills, ShowEachTargetAtEachBlurInTurn) {
  StillPlan plan = bare();
  plan.blurs_px = {0, 5, 10};
  const std::vector targets{disc(), quarters()};
  for (std::size_t rank = 0; rank < 12; ++rank) {
    const Still made = still(plan, targets, rank, 1);
    EXPECT_EQ(*made.shown, rank / 3 % 2);
    EXPECT_EQ(made.targets[*made.shown].label, Label::visible);
    EXPECT_EQ(made.targets[1 - *made.shown].label, Label::absent);
  }
}

TEST(Jumble, OfAPartIsThePartOfTheWhole) {
  const cv::Mat1b whole = jumble({320, 240}, {-20, -20, 360, 280}, 2, Random(3)),
                  part = jumble({320, 240}, {40, 30, 100, 80}, 2, Random(3));
  cv::Mat off;
  cv::absdiff(whole(cv::Rect(120, 100, 200, 160)), part, off);
  // The same but for rounding, and for posters cut by the border, which are laid with that of their visible part.
  cv::Mat beyond = off > 3;
  EXPECT_LT(cv::countNonZero(beyond(cv::Rect(4, 4, 192, 152))), 200);
}

TEST(Jumble, IsDenserThanFewThings) {
  double edges = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const cv::Mat1b made = jumble({320, 240}, {0, 0, 320, 240}, 1, Random(seed));
    cv::Mat1b found;
    cv::Canny(made, found, 60, 120);
    edges += cv::countNonZero(found) / (6.0 * static_cast<double>(made.total()));
  }
  EXPECT_GT(edges, 0.05) << "share of pixels on an edge";
}

TEST(Stills, AreReadBackAsARecordingWithTheSameTruth) {
  const Scratch scratch;
  StillPlan plan = bare();
  plan.blurs_px = {0, 9};
  plan.shown = 0.8;
  const std::vector targets{disc(), quarters()};
  write_stills(scratch.path() / "some", plan, targets, 6, 11, "seed = 11\n");
  const Sequence read = open_sequence(scratch.path() / "some");
  ASSERT_EQ(read.recording.frames(), 6u);
  ASSERT_EQ(read.recording.targets.size(), 2u);
  EXPECT_TRUE(std::filesystem::exists(scratch.path() / "some/stills.toml"));
  const auto frames = read.frames();
  for (std::size_t rank = 0; frames->next(); ++rank) {
    const Still made = still(plan, targets, rank, 11);
    EXPECT_EQ(cv::norm(read_only_mat(frames->image()), made.pixels, cv::NORM_INF), 0);
    for (std::size_t i = 0; i < 2; ++i) {
      const TargetTruth &truth = read.recording.truth_of(rank, i), &expected = made.targets[i];
      ASSERT_EQ(truth.label, expected.label);
      if (truth.label != Label::visible) continue;
      EXPECT_LT(norm(centre_of(*truth.outline) - centre_of(*expected.outline)), 1e-3);
      EXPECT_LT(norm(*truth.centre_projected - *expected.centre_projected), 1e-3);
      EXPECT_LT(norm(*truth.blur - *expected.blur), 1e-3);
      EXPECT_NEAR(*truth.tilt_deg, *expected.tilt_deg, 1e-2);
    }
  }
}

TEST(Stills, AreMadeAgainFromTheirOwnFile) {
  const Scratch scratch;
  StillsFile file;
  file.targets = {"ring:01"};
  file.seed = 4;
  file.plan.blurs_px = {0, 32.5};
  file.plan.tilt_deg = {30, 30};
  file.plan.backdrop = Backdrop::plain;
  file.plan.blur_in = BlurIn::light;
  scratch.write("plan.toml", stills_file_text(file));
  EXPECT_TRUE(is_stills_file(scratch.path() / "plan.toml"));
  EXPECT_EQ(stills_file_text(read_stills_file(scratch.path() / "plan.toml")), stills_file_text(file));
  scratch.write("plan.toml", "preset = \"stills\"\nsize_px = [1, 2, 3]\n");
  EXPECT_NE(fault_of([&] {
              read_stills_file(scratch.path() / "plan.toml");
            }).find("plan.toml:2:11: size_px must be a range"),
            std::string::npos);
}

TEST(Stills, NameWhatCannotBe) {
  const auto fault = [](auto change) {
    StillPlan plan;
    change(plan);
    return fault_of([&] { check_stills(plan); });
  };
  EXPECT_EQ(fault([](StillPlan&) {}), "");
  EXPECT_NE(fault([](StillPlan& p) { p.tilt_deg = {0, 95}; }).find("tilt_deg is 95"), std::string::npos);
  EXPECT_NE(fault([](StillPlan& p) { p.size_px = {90, 30}; }).find("size_px is 30"), std::string::npos);
  EXPECT_NE(fault([](StillPlan& p) { p.blurs_px = {}; }).find("blurs_px needs a length"), std::string::npos);
  StillPlan tight = bare();
  tight.size_px = {128, 128};
  tight.tilt_deg = {0, 0};
  EXPECT_NE(fault_of([&] { still_of(tight, quarters()); }).find("no room for quarters"), std::string::npos);
}

}  // namespace
}  // namespace relock::simulator
