#include "sequences/simulator/transport.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "core/opencv.h"
#include "sequences/open.h"
#include "sequences/simulator/preview.h"
#include "tests/sequences/scratch.h"

namespace relock::simulator {
namespace {

/// A picture of fine grey waves, a little tinted, that moves with `step`. (Not more: a video keeps a quarter of
/// the colours.)
cv::Mat moving(int step, cv::Size size = {160, 120}) {
  cv::Mat3b picture(size);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const double grey =
          128 + 50 * std::sin(0.4 * (x + 3 * step)) + 40 * std::sin(0.5 * (y + step) + 0.1 * x);
      const double tint = 10 * std::sin(0.05 * (x + y + step));
      picture(y, x) = {cv::saturate_cast<std::uint8_t>(grey - tint), cv::saturate_cast<std::uint8_t>(grey),
                       cv::saturate_cast<std::uint8_t>(grey + tint)};
    }
  return picture;
}

double rms(const cv::Mat& a, const cv::Mat& b) {
  return cv::norm(a, b, cv::NORM_L2) / std::sqrt(static_cast<double>(a.total()) * a.channels());
}

std::vector<cv::Mat> carried(double kbps, int pictures, cv::Size size = {160, 120}) {
  VideoLink link({size.width, size.height}, 30, kbps);
  std::vector<cv::Mat> all;
  for (int i = 0; i < pictures; ++i) {
    cv::Mat out;
    link.carry(moving(i, size), out);
    all.push_back(out);
  }
  return all;
}

double mean_rms(const std::vector<cv::Mat>& pictures) {
  double sum = 0;
  for (std::size_t i = 0; i < pictures.size(); ++i)
    sum += rms(pictures[i], moving(static_cast<int>(i), pictures[i].size()));
  return sum / static_cast<double>(pictures.size());
}

TEST(StoredPicture, IsTheSameAsPngAndCloseAsJpeg) {
  std::vector<std::uint8_t> bytes;
  TransportPlan plan{.jpeg_quality = 0};
  encode_picture(moving(1), plan, bytes);
  EXPECT_EQ(picture_suffix(plan), ".png");
  EXPECT_EQ(rms(cv::imdecode(bytes, cv::IMREAD_UNCHANGED), moving(1)), 0);
  const std::size_t lossless = bytes.size();
  plan.jpeg_quality = 90;
  encode_picture(moving(1), plan, bytes);
  EXPECT_EQ(picture_suffix(plan), ".jpg");
  EXPECT_LT(rms(cv::imdecode(bytes, cv::IMREAD_UNCHANGED), moving(1)), 5);
  EXPECT_LT(bytes.size(), lossless);
}

TEST(VideoLink, IsCloseToThePictureAtAHighBitRateAndFartherAtALowOne) {
  const double close = mean_rms(carried(20000, 20)), farther = mean_rms(carried(300, 20)),
               farthest = mean_rms(carried(60, 20));
  EXPECT_LT(close, 4);
  EXPECT_GT(farther, 1.2 * close);
  EXPECT_GT(farthest, 1.2 * farther);
}

TEST(VideoLink, GivesEachPictureAtOnceAndNotItsNeighbour) {
  const std::vector<cv::Mat> all = carried(20000, 8);
  for (int i = 1; i + 1 < 8; ++i) {
    const cv::Mat& here = all[static_cast<std::size_t>(i)];
    EXPECT_LT(3 * rms(here, moving(i)), rms(here, moving(i - 1)));
    EXPECT_LT(3 * rms(here, moving(i)), rms(here, moving(i + 1)));
  }
}

// libswscale makes 253 of white on the way back, here and wherever relock reads a video.
TEST(VideoLink, MovesNoGreyLevelByMoreThanTheReaderOfVideosDoes) {
  VideoLink link({64, 48}, 30, 5000);
  for (const int grey : {0, 16, 128, 235, 255}) {
    cv::Mat out;
    for (int i = 0; i < 5; ++i) link.carry(cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(grey)), out);
    EXPECT_NEAR(cv::mean(out)[1], grey, 2.5);
  }
}

TEST(VideoLink, TakesPicturesOfOddSides) {
  const std::vector<cv::Mat> all = carried(20000, 3, {161, 121});
  EXPECT_EQ(all[2].size(), cv::Size(161, 121));
  EXPECT_LT(mean_rms(all), 4);
}

TEST(VideoLink, GivesTheSamePicturesAgain) {
  const std::vector<cv::Mat> once = carried(200, 12), again = carried(200, 12);
  for (std::size_t i = 0; i < once.size(); ++i) EXPECT_EQ(rms(once[i], again[i]), 0);
}

TEST(VideoLink, RefusesAPictureOfAnotherSize) {
  VideoLink link({64, 48}, 30, 500);
  cv::Mat out;
  EXPECT_NE(fault_of([&] { link.carry(moving(0), out); }).find("160x120 of 3 channels"), std::string::npos);
}

TEST(Transport, NamesThePartOfItsPlanThatIsOutOfRange) {
  EXPECT_EQ(fault_of([] { check_transport({}); }), "");
  EXPECT_NE(fault_of([] { check_transport({.jpeg_quality = 101}); }).find("jpeg_quality"), std::string::npos);
  EXPECT_NE(fault_of([] { check_transport({.h264_kbps = -1}); }).find("h264_kbps"), std::string::npos);
}

TEST(Preview, KeepsTheTimesOfItsFramesWithTheirGaps) {
  const Scratch scratch;
  const auto path = scratch.path() / "flight.mp4";
  const std::vector<std::int64_t> times{5'000'000'000, 5'033'333'333, 5'066'666'667, 15'100'000'000,
                                        15'133'334'000};
  PreviewWriter preview(path, {160, 120}, 30);
  for (std::size_t i = 0; i < times.size(); ++i) preview.add(moving(static_cast<int>(i)), time_ns(times[i]));
  EXPECT_FALSE(std::filesystem::exists(path)) << "it is there whole or not at all";
  preview.finish();
  const Sequence read = open_sequence(path);
  ASSERT_EQ(read.recording.frames(), times.size());
  for (std::size_t i = 0; i < times.size(); ++i)
    EXPECT_NEAR(static_cast<double>((read.recording.captured[i] - read.recording.captured[0]).count()),
                static_cast<double>(times[i] - times[0]), 1000);
  const auto frames = read.frames();
  for (int i = 0; frames->next(); ++i) EXPECT_LT(rms(read_only_mat(frames->image()), moving(i)), 6);
}

TEST(Preview, IsGoneWhenItIsNotFinishedAndWritesOverNothing) {
  const Scratch scratch;
  { PreviewWriter(scratch.path() / "a.mp4", {160, 120}, 30).add(moving(0), time_ns(0)); }
  EXPECT_TRUE(std::filesystem::is_empty(scratch.path()));
  scratch.write("a.mp4", "mine");
  EXPECT_NE(fault_of([&] {
              PreviewWriter(scratch.path() / "a.mp4", {160, 120}, 30);
            }).find("is there already"),
            std::string::npos);
  PreviewWriter preview(scratch.path() / "b.mp4", {160, 120}, 30);
  preview.add(moving(0), time_ns(70));
  EXPECT_NE(fault_of([&] { preview.add(moving(1), time_ns(70)); }).find("cannot follow"), std::string::npos);
}

TEST(Preview, SaysSoWhenTheDiskFillsUp) {
  const Scratch scratch;
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  auto* const handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{4096, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string fault = fault_of([&] {
    PreviewWriter preview(scratch.path() / "a.mp4", {160, 120}, 30);
    for (int i = 0; i < 20; ++i) preview.add(moving(i), time_ns(33'333'333LL * i));
    preview.finish();
  });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_NE(fault.find("a.mp4 cannot be written; is the disk full"), std::string::npos) << fault;
  EXPECT_TRUE(std::filesystem::is_empty(scratch.path()));
}

TEST(Preview, IsTheSameBytesAgain) {
  const Scratch scratch;
  const auto written = [&](const std::string& name) {
    PreviewWriter preview(scratch.path() / name, {160, 120}, 30);
    for (int i = 0; i < 5; ++i) preview.add(moving(i), time_ns(33'333'333LL * i));
    preview.finish();
    std::ifstream in(scratch.path() / name, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  EXPECT_EQ(written("a.mp4"), written("b.mp4"));
}

}  // namespace
}  // namespace relock::simulator
