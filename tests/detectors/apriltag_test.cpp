#include "detectors/apriltag.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/opencv.h"
#include "tests/detectors/rendered_marker.h"

namespace relock {
namespace {

ApriltagOptions with(const std::map<std::string, std::string>& given) {
  return apriltag_options(Options("apriltag", apriltag_option_list(), given));
}

TEST(ApriltagOptions, WithoutAnyGivenAreTheDefaultsThatAreListed) {
  const ApriltagOptions defaults, read = with({});
  EXPECT_EQ(read.family, defaults.family);
  EXPECT_EQ(read.decimate, defaults.decimate);
  EXPECT_EQ(read.sigma_px, defaults.sigma_px);
  EXPECT_EQ(read.threads, defaults.threads);
  EXPECT_EQ(read.hamming, defaults.hamming);
  EXPECT_EQ(read.min_margin, defaults.min_margin);
}

TEST(ApriltagOptions, RefuseAFamilyThatIsNone) {
  EXPECT_THROW(with({{"family", "tag36h12"}}), Error);
  EXPECT_THROW(with({{"hamming", "3"}}), Error);
  EXPECT_THROW(apriltag_cells("tag36h12", 1), Error);
}

TEST(ApriltagDetector, ReadsEveryFamilyItLists) {
  for (const std::string family :
       {"tag36h11", "tag36h10", "tag25h9", "tag16h5", "tagStandard41h12", "tagCircle21h7"}) {
    const Quad outline = square({60.2, 60.7}, 50, 0.2);
    const auto picture = rendered_marker(apriltag_cells(family, 17), outline, {120, 120});
    const auto found = apriltag_detector(with({{"family", family}}))->detect(view(picture));
    ASSERT_EQ(found.size(), 1u) << family;
    EXPECT_EQ(to_string(*found[0].code), "april" + family + ":17");
    EXPECT_LT(norm(std::get<Quad>(found[0].outline).corner[0] - outline.corner[0]), 0.5) << family;
  }
}

TEST(ApriltagDetector, LeavesThePictureAsItWasWhenItBlursOrSharpensBeforeLooking) {
  for (const char* sigma : {"0.8", "-0.8"})
    for (const char* decimate : {"1", "2"}) {
      const auto picture = rendered_marker(apriltag_cells("tag36h11", 5), square({60, 60}, 60), {120, 120});
      const cv::Mat before = picture.clone();
      apriltag_detector(with({{"sigma_px", sigma}, {"decimate", decimate}}))->detect(view(picture));
      EXPECT_EQ(cv::norm(before, picture, cv::NORM_L1), 0.0);
    }
}

TEST(ApriltagDetector, HasNoBiasWhenItLooksInASmallerPicture) {
  for (const char* decimate : {"1", "1.5", "2", "3"}) {
    const Quad outline = square({80.3, 80.6}, 70, 0.2);
    const auto picture = rendered_marker(apriltag_cells("tag36h11", 5), outline, {160, 160});
    const auto found = apriltag_detector(with({{"decimate", decimate}}))->detect(view(picture));
    ASSERT_EQ(found.size(), 1u) << decimate;
    EXPECT_LT(norm(found[0].centre - centre_of(outline)), 0.15) << decimate;
  }
}

TEST(ApriltagDetector, FindsSmallTagsThatDecimationLoses) {
  const auto picture =
      rendered_marker(apriltag_cells("tag36h11", 5), square({60.2, 60.4}, 16, 0.2), {120, 120});
  EXPECT_EQ(apriltag_detector({})->detect(view(picture)).size(), 1u);
  EXPECT_EQ(apriltag_detector(with({{"decimate", "2"}}))->detect(view(picture)).size(), 0u);
}

TEST(ApriltagDetector, IsLessSureOfAFaintTag) {
  const auto picture = rendered_marker(apriltag_cells("tag36h11", 5), square({60, 60}, 60), {120, 120});
  cv::Mat1b faint;
  picture.convertTo(faint, CV_8U, 0.3, 80);
  const auto detector = apriltag_detector({});
  const double sharp = detector->detect(view(picture)).at(0).confidence;
  const double pale = detector->detect(view(faint)).at(0).confidence;
  EXPECT_LE(sharp, 1.0);
  EXPECT_LT(pale, 0.5 * sharp);
  EXPECT_TRUE(apriltag_detector(with({{"min_margin", "100"}}))->detect(view(faint)).empty());
}

}  // namespace
}  // namespace relock
