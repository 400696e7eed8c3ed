#include "detectors/aruco.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/opencv.h"
#include "core/stage.h"
#include "tests/detectors/rendered_marker.h"

namespace relock {
namespace {

ArucoOptions with(const std::map<std::string, std::string>& given) {
  return aruco_options(Options("aruco", aruco_option_list(), given));
}

TEST(ArucoOptions, WithoutAnyGivenAreTheDefaultsThatAreListed) {
  const ArucoOptions defaults, read = with({});
  EXPECT_EQ(read.dictionary, defaults.dictionary);
  EXPECT_EQ(read.corner_refinement, defaults.corner_refinement);
  EXPECT_EQ(read.min_side_px, defaults.min_side_px);
  EXPECT_EQ(read.error_correction, defaults.error_correction);
  EXPECT_EQ(read.threshold_constant, defaults.threshold_constant);
}

TEST(ArucoOptions, RefuseADictionaryThatIsNone) {
  EXPECT_THROW(with({{"dictionary", "6x6_300"}}), Error);
  EXPECT_THROW(with({{"corner_refinement", "best"}}), Error);
  EXPECT_THROW(aruco_cells("6x6_300", 1), Error);
}

TEST(ArucoDetector, ReadsEveryDictionaryItLists) {
  for (const int bits : {4, 5, 6, 7})
    for (const int size : {50, 100, 250, 1000}) {
      const auto name = std::to_string(bits) + "x" + std::to_string(bits) + "_" + std::to_string(size);
      const auto options = with({{"dictionary", name}});
      const auto picture = rendered_marker(aruco_cells(name, size - 1), square({60, 60}, 60), {120, 120});
      const auto found = aruco_detector(options)->detect(view(picture));
      ASSERT_EQ(found.size(), 1u) << name;
      EXPECT_EQ(to_string(*found[0].code), "aruco" + name + ":" + std::to_string(size - 1));
    }
}

TEST(ArucoDetector, ReadsTheOriginalMarkers) {
  const auto picture = rendered_marker(aruco_cells("original", 582), square({60, 60}, 60), {120, 120});
  const auto found = aruco_detector(with({{"dictionary", "original"}}))->detect(view(picture));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(to_string(*found[0].code), "arucooriginal:582");
}

TEST(ArucoDetector, FindsTheSmallestMarkerLookedForWhateverTheSizeOfThePicture) {
  const Quad outline = square({60.3, 60.6}, 20);
  for (const Size size : {Size{120, 120}, Size{1500, 200}}) {
    const auto picture = rendered_marker(aruco_cells("6x6_250", 7), outline, size);
    EXPECT_EQ(aruco_detector(with({{"min_side_px", "15"}}))->detect(view(picture)).size(), 1u);
    EXPECT_EQ(aruco_detector(with({{"min_side_px", "25"}}))->detect(view(picture)).size(), 0u);
  }
}

TEST(ArucoDetector, FindsAMarkerWhosePaperEndsCloseToIt) {
  // OpenCV's own setting takes such a marker and the edge of its paper for one thing (before 4.9).
  for (const double turn : {0.0, 0.4, 0.8}) {
    const auto picture = rendered_marker(aruco_cells("6x6_250", 7), square({90, 90}, 72, turn), {180, 180});
    EXPECT_EQ(aruco_detector({})->detect(view(picture)).size(), 1u) << turn;
  }
}

TEST(ArucoDetector, ShowsItsStagesWhateverItIsShown) {
  const auto picture = rendered_marker(aruco_cells("6x6_250", 7), square({90, 90}, 72), {180, 180});
  const auto detector = aruco_detector({});
  auto& explaining = dynamic_cast<ExplainingDetector&>(*detector);
  const auto names = [](const std::vector<Stage>& stages) {
    std::string all;
    for (const Stage& stage : stages)
      all += stage.name + (std::get<Picture>(stage.shown).pixels.empty() ? "!" : " ");
    return all;
  };
  const auto stages = explaining.explain(view(picture));
  EXPECT_EQ(names(stages), "threshold candidates answer ");
  EXPECT_EQ(stages.back().sentence.substr(0, 8), "1 marker");
  // The border is white in the first one.
  EXPECT_EQ(std::get<Picture>(stages[0].shown).view().row(90)[90 - 34], 255);
  EXPECT_EQ(names(explaining.explain(view(cv::Mat(cv::Mat::zeros(1, 1, CV_8UC1))))),
            "threshold candidates answer ");
  EXPECT_EQ(names(explaining.explain(view(picture), Box{500, 500, 20, 20})), "candidates answer ");
  EXPECT_THROW(explaining.explain(Image()), Error);
}

TEST(ArucoDetector, RefinesCornersSoThatTheyComeNearerToThePrint) {
  const Quad outline = square({90.3, 90.8}, 88, 0.35);
  const auto picture = rendered_marker(aruco_cells("6x6_250", 7), outline, {180, 180});
  const auto off = [&](const std::string& refinement) {
    const auto found = aruco_detector(with({{"corner_refinement", refinement}}))->detect(view(picture));
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i)
      sum += norm(std::get<Quad>(found.at(0).outline).corner[i] - outline.corner[i]) / 4;
    return sum;
  };
  EXPECT_LT(off("subpix"), 0.25);
  EXPECT_GT(off("contour"), 0.4);  // it runs through the middles of the black pixels
  EXPECT_GT(off("none"), 0.4);
}

}  // namespace
}  // namespace relock
