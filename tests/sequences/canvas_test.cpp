#include "sequences/simulator/canvas.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <fstream>
#include <opencv2/core.hpp>

#include "core/opencv.h"
#include "sequences/open.h"
#include "tests/sequences/printed.h"
#include "tests/sequences/scratch.h"

namespace relock::simulator {
namespace {

namespace fs = std::filesystem;

CanvasPlan one_picture(double length, double angle, double noise) {
  return {.lengths_px = {length}, .angles_deg = {angle}, .noise = noise};
}

/// Centre of all that is unlike the grey around, no farther than 120 px from the middle.
Vec2 centroid(const cv::Mat1b& picture, double grey) {
  double sum = 0, sum_x = 0, sum_y = 0;
  for (int y = picture.rows / 2 - 120; y < picture.rows / 2 + 120; ++y)
    for (int x = picture.cols / 2 - 120; x < picture.cols / 2 + 120; ++x) {
      const double weight = grey - picture(y, x);
      sum += weight, sum_x += weight * x, sum_y += weight * y;
    }
  return {sum_x / sum, sum_y / sum};
}

/// Bilinear interpolation of a sheet, at px of the canvas; the grey around it outside.
double sampled(const PrintedTarget& target, const CanvasPlan& plan, Vec2 centre, Vec2 at) {
  const double per_pixel = target.picture.cols / (plan.marker_px * target.sheet_m / target.size_m);
  const double middle = (target.picture.cols - 1) / 2.0, end = target.picture.cols - 1;
  const double u = middle + (at.x - centre.x) * per_pixel, v = middle + (at.y - centre.y) * per_pixel;
  if (!(u >= -0.5 && v >= -0.5 && u < end + 0.5 && v < end + 0.5)) return plan.grey;
  const double x = std::clamp(u, 0.0, end), y = std::clamp(v, 0.0, end);
  const int left = std::min(static_cast<int>(x), target.picture.cols - 2),
            top = std::min(static_cast<int>(y), target.picture.rows - 2);
  const cv::Mat1b sheet = target.picture;
  const auto row = [&](int r) { return sheet(r, left) + (x - left) * (sheet(r, left + 1) - sheet(r, left)); };
  return row(top) + (y - top) * (row(top + 1) - row(top));
}

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(Canvas, WithoutBlurAndNoiseIsThePlainMarker) {
  CanvasPlan plan = one_picture(0, 0, 0);
  plan.canvas_px = 96;
  plan.marker_px = 40.3;
  const PrintedTarget target = quarters();
  const CanvasPicture made = canvas_picture(plan, target, 0, 5);
  const cv::Mat1b pixels = made.pixels;
  const Vec2 centre = *made.truth.centre_projected;
  constexpr int kSamples = 40;
  for (int y = 0; y < 96; ++y)
    for (int x = 0; x < 96; ++x) {
      double sum = 0;
      for (int i = 0; i < kSamples * kSamples; ++i)
        sum +=
            sampled(target, plan, centre,
                    {x - 0.5 + (i % kSamples + 0.5) / kSamples, y - 0.5 + (i / kSamples + 0.5) / kSamples});
      ASSERT_NEAR(pixels(y, x), sum / (kSamples * kSamples), 0.5 + 128.0 / kSamples) << x << " " << y;
    }
}

TEST(Canvas, HasItsDiscWhereTheLabelSays) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
    for (const BlurIn blur_in : {BlurIn::coded, BlurIn::light})
      for (const double angle : {0.0, 22.0, 45.0, 90.0, 135.0}) {
        const auto off_by = [&](double length, double noise) {
          CanvasPlan plan = one_picture(length, angle, noise);
          plan.blur_in = blur_in;
          const CanvasPicture made = canvas_picture(plan, disc(), 0, seed);
          return norm(centroid(made.pixels, plan.grey) - *made.truth.centre_projected);
        };
        EXPECT_LT(off_by(0, 0), 0.03);
        EXPECT_LT(off_by(50, 0), 0.03);
        EXPECT_LT(off_by(50, 2), 0.1);
      }
}

TEST(Canvas, BlursAlongItsAngleAndNotAcross) {
  const auto width = [](const cv::Mat1b& picture, cv::Point step) {
    int count = 0;
    for (cv::Point at(240, 240); picture(at) < 126; at += step) ++count;
    return count;
  };
  const cv::Mat sharp = canvas_picture(one_picture(0, 45, 0), disc(), 0, 1).pixels,
                blurred = canvas_picture(one_picture(60, 45, 0), disc(), 0, 1).pixels;
  EXPECT_GT(width(blurred, {1, 1}), width(sharp, {1, 1}) + 10) << "from +x towards +y, which is down";
  EXPECT_NEAR(width(blurred, {1, -1}), width(sharp, {1, -1}), 3);
  const TargetTruth truth = canvas_picture(one_picture(60, 45, 0), disc(), 0, 1).truth;
  EXPECT_NEAR(truth.blur->x, 60 / std::sqrt(2), 1e-9);
  EXPECT_NEAR(truth.blur->y, 60 / std::sqrt(2), 1e-9);
}

TEST(Canvas, HasNoiseOfTheStatedDeviation) {
  const cv::Mat noisy = canvas_picture(one_picture(0, 0, 6), disc(), 0, 3).pixels;
  cv::Scalar mean, deviation;
  cv::meanStdDev(noisy.rowRange(0, 100), mean, deviation);  // beside the sheet
  EXPECT_NEAR(mean[0], 128, 0.15);
  EXPECT_NEAR(deviation[0], std::sqrt(36 + 1 / 12.0), 0.1);
}

TEST(Canvas, PutsTheMarkerElsewhereInEachPicture) {
  CanvasPlan plan = one_picture(0, 0, 0);
  plan.repetitions = 20;
  const double middle = (plan.canvas_px - 1) / 2.0;
  std::vector<double> found;
  for (std::size_t i = 0; i < canvas_pictures(plan); ++i) {
    const Vec2 centre = *canvas_picture(plan, quarters(), i, 1).truth.centre_projected;
    EXPECT_LE(std::max(std::abs(centre.x - middle), std::abs(centre.y - middle)), 0.5);
    found.push_back(centre.x);
  }
  std::sort(found.begin(), found.end());
  EXPECT_EQ(std::unique(found.begin(), found.end()), found.end());
  EXPECT_GT(found.back() - found.front(), 0.5);
}

TEST(Canvas, IsReadBackAsARecordingWithTheSameTruth) {
  const Scratch scratch;
  const fs::path folder = scratch.path() / "experiment";
  CanvasPlan plan{.lengths_px = {0, 50}, .angles_deg = {0, 67, 157}, .repetitions = 2};
  for (const PrintedTarget& target : {disc(), quarters()}) {
    write_canvas(folder, plan, target, 9);
    const Sequence read = open_sequence(folder);
    EXPECT_EQ(read.recording.name, "experiment");
    ASSERT_EQ(read.recording.frames(), 12u);
    ASSERT_EQ(read.recording.targets.size(), 1u);
    EXPECT_EQ(read.recording.targets[0], (Target{target.name, target.code, target.size_m}));
    const auto frames = read.frames();
    for (std::size_t i = 0; frames->next(); ++i) {
      const CanvasPicture made = canvas_picture(plan, target, i, 9);
      EXPECT_EQ(cv::norm(read_only_mat(frames->image()), made.pixels, cv::NORM_INF), 0);
      const TargetTruth& truth = read.recording.truth_of(i, 0);
      EXPECT_EQ(truth.label, Label::visible);
      EXPECT_EQ(truth.visible_fraction, 1);
      EXPECT_EQ(truth.sigma_px, 0);
      EXPECT_EQ(truth.outline->index(), made.truth.outline->index());
      EXPECT_NEAR(norm(centre_of(*truth.outline) - centre_of(*made.truth.outline)), 0, 1e-4);
      EXPECT_NEAR(norm(*truth.centre_projected - *made.truth.centre_projected), 0, 1e-4);
      EXPECT_NEAR(truth.size_px(), 150, 1e-3);
      EXPECT_NEAR(norm(*truth.blur - *made.truth.blur), 0, 1e-4);
    }
    fs::remove_all(folder);
  }
}

TEST(Canvas, IsTheSameBytesForTheSameSeed) {
  const Scratch scratch;
  const CanvasPlan plan{.lengths_px = {0, 30}, .angles_deg = {22}};
  for (const auto& [name, seed] : {std::pair("a/x", 4), std::pair("b/x", 4), std::pair("c/x", 5)})
    write_canvas(scratch.path() / name, plan, disc(), static_cast<std::uint64_t>(seed));
  for (const char* file : {"images/000001.png", "labels.csv"}) {
    EXPECT_EQ(content(scratch.path() / "a/x" / file), content(scratch.path() / "b/x" / file));
    EXPECT_NE(content(scratch.path() / "a/x" / file), content(scratch.path() / "c/x" / file));
  }
  for (const char* file : {"timestamps.csv", "recording.toml"})
    EXPECT_EQ(content(scratch.path() / "a/x" / file), content(scratch.path() / "b/x" / file));
}

TEST(Canvas, LeavesNothingBehindOnADiskThatFillsUpAndSaysSo) {
  const Scratch scratch;
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  auto* const handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{4096, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string fault =
      fault_of([&] { write_canvas(scratch.path() / "x", one_picture(0, 0, 9), disc(), 1); });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_NE(fault.find("000000.png cannot be written; is the disk full?"), std::string::npos) << fault;
  EXPECT_TRUE(fs::is_empty(scratch.path()));
}

TEST(Canvas, WritesOverNothing) {
  const Scratch scratch;
  scratch.write("x/notes.txt", "mine");
  EXPECT_NE(fault_of([&] { write_canvas(scratch.path() / "x", {}, disc(), 1); }).find("is there already"),
            std::string::npos);
}

TEST(Canvas, NamesWhatCannotBe) {
  EXPECT_EQ(fault_of([] { check_canvas({}); }), "");
  EXPECT_NE(fault_of([] {
              check_canvas({.canvas_px = 200});
            }).find("has no room for a marker of 150 px blurred by"),
            std::string::npos);
  EXPECT_NE(fault_of([] { check_canvas({.angles_deg = {}}); }).find("needs a length, an angle"),
            std::string::npos);
  const Scratch scratch;
  PrintedTarget blank = disc();
  blank.picture = cv::Mat();
  EXPECT_NE(fault_of([&] { write_canvas(scratch.path() / "x", {}, blank, 1); }).find("sheet of disc:1"),
            std::string::npos);
}

}  // namespace
}  // namespace relock::simulator
