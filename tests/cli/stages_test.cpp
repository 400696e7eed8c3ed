// `relock detect --explain` with a detector of the test's own, and what pictures detect takes.
#include "cli/stages.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <opencv2/imgcodecs.hpp>

#include "cli/drawing.h"
#include "cli/files.h"
#include "cli/json_text.h"
#include "cli/verbs.h"
#include "core/error.h"
#include "core/opencv.h"

namespace relock {
namespace {

namespace fs = std::filesystem;

/// Answers with the whole picture, and with its grey level as the code; shows the picture and a chart.
class Whole final : public ExplainingDetector {
 public:
  Sightings detect(const Image& image, const std::optional<Box>&) override {
    Sighting all = sighting_of(picture_box(image.size()));
    all.code = Code{"grey", std::to_string(image.row(0)[0])};
    return {all};
  }
  std::vector<Stage> explain(const Image& image, const std::optional<Box>&) override {
    return {{"first look", "what was given", image},
            {"profile", "its \"levels\" < 256 & more", Chart{"x [px]", "level", {{"", {{0, 1}, {1, 2}}}}}}};
  }
};

class Silent final : public Detector {
 public:
  Sightings detect(const Image&, const std::optional<Box>&) override { return {}; }
};

Methods two_methods() {
  Methods methods;
  methods.detectors.add({.name = "whole", .sentence = "all of it", .make = [](const Options&, std::uint64_t) {
                           return std::make_unique<Whole>();
                         }});
  methods.detectors.add({.name = "silent", .sentence = "nothing", .make = [](const Options&, std::uint64_t) {
                           return std::make_unique<Silent>();
                         }});
  return methods;
}

class Explained : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path picture(const std::string& name, const cv::Mat& pixels) const {
    cv::imwrite((folder_ / name).string(), pixels);
    return folder_ / name;
  }
  std::string said(const DetectArguments& arguments) const {
    testing::internal::CaptureStdout();
    try {
      detect(arguments, two_methods());
    } catch (const Error& fault) {
      testing::internal::GetCapturedStdout();
      return fault.what();
    }
    std::fflush(stdout);
    return testing::internal::GetCapturedStdout();
  }
  /// The grey level that the detector was shown.
  std::string level_of(const fs::path& picture) const {
    const std::string text = said({.images = {picture}, .method = "whole", .json = true});
    return text.starts_with("{") ? Json::parse(text)["sightings"][0]["code"].get<std::string>() : text;
  }

  const fs::path folder_ =
      fs::temp_directory_path() / fmt::format("relock-explained-{}-{}", getpid(),
                                              testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(Explained, WritesEveryStageAndTellsOfItInOrder) {
  const cv::Mat pixels(6, 8, CV_8UC3, cv::Scalar(7, 8, 9));
  const std::string out = (folder_ / "out").string();
  const std::string text =
      said({.images = {picture("a.png", pixels)}, .method = "whole", .explain = true, .out = out});
  EXPECT_EQ(text.substr(0, text.find(folder_.string() + "/a.png: grey:7 at")),
            fmt::format("1 first look: what was given ({0}/1-first-look.png)\n"
                        "2 profile: its \"levels\" < 256 & more ({0}/2-profile.svg)\n",
                        out));
  EXPECT_EQ(cv::norm(cv::imread(out + "/1-first-look.png"), pixels, cv::NORM_INF), 0);
  EXPECT_NE(read_file(out + "/2-profile.svg").find(">its \"levels\" &lt; 256 &amp; more<"),
            std::string::npos);
}

TEST_F(Explained, KeepsEachPictureInAFolderOfItsOwn) {
  const fs::path one = picture("1.png", cv::Mat(6, 8, CV_8UC1, cv::Scalar(1)));
  const fs::path two = picture("2.png", cv::Mat(6, 8, CV_8UC1, cv::Scalar(2)));
  said({.images = {one, two}, .method = "whole", .explain = true, .out = folder_ / "out"});
  EXPECT_EQ(
      cv::imread((folder_ / "out" / "1-first-look.png").string(), cv::IMREAD_GRAYSCALE).at<std::uint8_t>(0),
      1);
  EXPECT_EQ(
      cv::imread((folder_ / "out-2" / "1-first-look.png").string(), cv::IMREAD_GRAYSCALE).at<std::uint8_t>(0),
      2);
}

TEST_F(Explained, IsPartOfTheJson) {
  const fs::path one = picture("1.png", cv::Mat(6, 8, CV_8UC1, cv::Scalar(1)));
  const Json line = Json::parse(
      said({.images = {one}, .method = "whole", .json = true, .explain = true, .out = folder_ / "out"}));
  EXPECT_EQ(line["stages"].size(), 2u);
  EXPECT_EQ(line["stages"][1]["file"], (folder_ / "out" / "2-profile.svg").string());
}

TEST_F(Explained, SaysWhichDetectorsShowTheirStagesWhenThisOneDoesNot) {
  const fs::path one = picture("1.png", cv::Mat(6, 8, CV_8UC1, cv::Scalar(1)));
  EXPECT_EQ(said({.images = {one}, .method = "silent", .explain = true, .out = folder_ / "out"}),
            "silent does not show its stages; these detectors do: whole");
  EXPECT_FALSE(fs::exists(folder_ / "out"));
  EXPECT_EQ(explaining_detectors(two_methods()), std::vector<std::string>{"whole"});
}

TEST_F(Explained, CannotBeInAPlaceThatIsTaken) {
  const fs::path one = picture("1.png", cv::Mat(6, 8, CV_8UC1, cv::Scalar(1)));
  EXPECT_NE(
      said({.images = {one}, .method = "whole", .explain = true, .out = one}).find("1.png cannot be made"),
      std::string::npos);
}

TEST_F(Explained, ShowsNoEmptyPicture) {
  EXPECT_THROW(write_stages({{"nothing", "there is nothing", Picture()}}, folder_), Error);
}

TEST_F(Explained, PicturesOf16BitsKeepTheNearestOf256Levels) {
  EXPECT_EQ(level_of(picture("16.png", cv::Mat(6, 8, CV_16UC1, cv::Scalar(100 * 257)))), "grey:100");
  EXPECT_EQ(level_of(picture("16.png", cv::Mat(6, 8, CV_16UC1, cv::Scalar(100 * 257 + 128)))), "grey:100");
  EXPECT_EQ(level_of(picture("16.png", cv::Mat(6, 8, CV_16UC1, cv::Scalar(100 * 257 + 129)))), "grey:101");
  EXPECT_EQ(level_of(picture("16.png", cv::Mat(6, 8, CV_16UC3, cv::Scalar(65535, 0, 0)))), "grey:255");
}

TEST_F(Explained, TransparencyChangesNothing) {
  EXPECT_EQ(level_of(picture("a.png", cv::Mat(6, 8, CV_8UC4, cv::Scalar(40, 50, 60, 0)))), "grey:40");
}

TEST_F(Explained, WhatIsNoPictureIsRefusedInOneSentence) {
  const std::string file = (folder_ / "f").string();
  EXPECT_EQ(level_of(picture("f.hdr", cv::Mat(6, 8, CV_32FC3, cv::Scalar(1, 1, 1)))),
            file + ".hdr: this picture's pixels are neither of 8 nor of 16 bits; relock reads no others");
  write_file(file, "no picture");
  EXPECT_EQ(level_of(file), file + ": this is no picture that can be read");
  EXPECT_EQ(level_of(file + "2"), file + "2 does not exist");
  EXPECT_EQ(level_of(folder_), folder_.string() + " is a folder, not a picture");
  EXPECT_EQ(level_of(picture("1.png", cv::Mat(1, 1, CV_8UC1, cv::Scalar(3)))), "grey:3")
      << "the smallest is taken";
}

TEST(Drawing, LeavesThePictureAndShowsWhatWasSeen) {
  const cv::Mat grey(200, 300, CV_8UC1, cv::Scalar(128));
  const cv::Mat before = grey.clone();
  Sighting ring = sighting_of(Ellipse{{150, 100}, 50, 30, 0});
  ring.code = Code{"ring2", "01"};
  const cv::Mat canvas = drawn(grey, {ring});
  EXPECT_EQ(cv::norm(grey, before, cv::NORM_INF), 0);
  const auto differs = [&](int x, int y, const cv::Vec3b& colour) {
    return cv::norm(canvas.at<cv::Vec3b>(y, x), colour, cv::NORM_INF);
  };
  // Lines are smoothed, so that their colours are only nearly theirs.
  EXPECT_LT(differs(200, 100, {115, 158, 0}), 40) << "the outline's rightmost point is green";
  EXPECT_LT(differs(150, 100, {0, 94, 213}), 40) << "its centre is orange";
  EXPECT_EQ(differs(150, 85, {128, 128, 128}), 0) << "the rest is as it was";
}

TEST(Drawing, WritesLabelsIntoThePictureWhereverTheTargetIs) {
  const cv::Mat grey(100, 200, CV_8UC1, cv::Scalar(128));
  for (const Vec2 corner : {Vec2{0, 0}, Vec2{190, 0}, Vec2{0, 90}, Vec2{190, 90}}) {
    const cv::Mat canvas = drawn(grey, {sighting_of(Box{corner.x, corner.y, 9, 9})});
    cv::Mat white;
    cv::inRange(canvas, cv::Scalar(200, 200, 200), cv::Scalar(255, 255, 255), white);
    EXPECT_GT(cv::countNonZero(white), 30) << corner.x << " " << corner.y;
  }
}

}  // namespace
}  // namespace relock
