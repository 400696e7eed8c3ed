// What holds for every detector of square markers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "core/error.h"
#include "core/opencv.h"
#include "detectors/apriltag.h"
#include "detectors/aruco.h"
#include "tests/detectors/rendered_marker.h"

namespace relock {
namespace {

constexpr Size kPicture{240, 180};
constexpr double kRightAngle = std::numbers::pi / 2;

struct Kind {
  std::string name;
  std::function<std::unique_ptr<Detector>()> make;
  std::function<MarkerCells(int)> cells;
  std::string family;
};
void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }

class SquareMarkers : public testing::TestWithParam<Kind> {
 protected:
  std::unique_ptr<Detector> detector = GetParam().make();
  MarkerCells cells = GetParam().cells(23);

  cv::Mat1b shown(const Quad& outline) const { return rendered_marker(cells, outline, kPicture); }
  Code code(int id) const { return {GetParam().family, std::to_string(id)}; }
};

double distance_between_corners(const Quad& a, const Quad& b) {
  double largest = 0;
  for (std::size_t i = 0; i < 4; ++i) largest = std::max(largest, norm(a.corner[i] - b.corner[i]));
  return largest;
}

TEST_P(SquareMarkers, AreFoundWithinAFifthOfAPixelWhereverTheyLieBetweenThePixels) {
  for (const Vec2 part : {Vec2{0, 0}, Vec2{0.25, 0.5}, Vec2{0.5, 0.5}, Vec2{0.7, 0.1}}) {
    const Quad outline = square(Vec2{118, 88} + part, 72, 0.3);
    const auto found = detector->detect(view(shown(outline)));
    ASSERT_EQ(found.size(), 1u);
    EXPECT_LT(norm(found[0].centre - centre_of(outline)), 0.2);
    EXPECT_EQ(found[0].centre_kind, CentreKind::projected);
    EXPECT_EQ(found[0].code, code(23));
  }
}

TEST_P(SquareMarkers, HaveNoBiasOfHalfAPixel) {
  Vec2 sum;
  double outward = 0;
  constexpr int kTurns = 12;
  for (int turn = 0; turn < kTurns; ++turn) {
    const Quad outline = square({119.3 + 0.07 * turn, 90.2 + 0.09 * turn}, 72, 0.1 + turn * kRightAngle / 3);
    const auto found = detector->detect(view(shown(outline)));
    ASSERT_EQ(found.size(), 1u);
    sum = sum + (1.0 / kTurns) * (found[0].centre - centre_of(outline));
    outward += (size_of(found[0].outline) - size_of(outline)) / kTurns;
  }
  EXPECT_LT(norm(sum), 0.05);
  // A contour through the middles of the outermost black pixels would make it a whole pixel too small.
  EXPECT_LT(std::abs(outward), 0.4);
}

TEST_P(SquareMarkers, AreFoundAtTheirPhysicalCentreUnderPerspective) {
  const Quad outline = tilted({120.4, 90.7}, 96);
  const auto found = detector->detect(view(shown(outline)));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_LT(norm(found[0].centre - diagonals_meet(outline)), 0.15);
  EXPECT_GT(norm(centre_of(outline) - diagonals_meet(outline)), 1.0);  // the two centres do differ here
}

TEST_P(SquareMarkers, GiveTheirCornersFromTheTopLeftOfTheUprightMarkerHoweverTheyAreTurned) {
  for (int quarter = 0; quarter < 4; ++quarter) {
    const Quad outline = square({120.2, 90.4}, 64, quarter * kRightAngle);
    const auto found = detector->detect(view(shown(outline)));
    ASSERT_EQ(found.size(), 1u);
    EXPECT_LT(distance_between_corners(std::get<Quad>(found[0].outline), outline), 0.5)
        << quarter << " quarters";
  }
}

TEST_P(SquareMarkers, AreReadWhenSeveralAreShown) {
  cv::Mat1b picture = rendered_marker(GetParam().cells(3), square({60, 90}, 46), kPicture);
  render_into(picture, GetParam().cells(4), square({175, 90}, 52));
  const auto found = detector->detect(view(picture));
  ASSERT_EQ(found.size(), 2u);
  std::vector<Code> codes{*found[0].code, *found[1].code};
  std::sort(codes.begin(), codes.end());
  EXPECT_EQ(codes, (std::vector{code(3), code(4)}));
}

TEST_P(SquareMarkers, AreSeenTheSameWhateverWasShownBefore) {
  const cv::Mat1b picture = shown(square({120, 90}, 60, 0.2));
  const auto fresh = GetParam().make()->detect(view(picture));
  detector->detect(view(shown(tilted({100, 80}, 90))));
  detector->detect(view(rendered_marker(GetParam().cells(4), square({40, 40}, 50), {100, 80})));
  detector->detect(view(bgr_of(picture)));
  EXPECT_EQ(detector->detect(view(picture)), fresh);
}

TEST_P(SquareMarkers, AreFoundWhereTheHintSaysAndNotFarFromIt) {
  cv::Mat1b picture = rendered_marker(GetParam().cells(3), square({60, 90}, 50), kPicture);
  const Quad wanted = square({180.3, 90.6}, 50);
  render_into(picture, GetParam().cells(4), wanted);
  const auto found = detector->detect(view(picture), bounds(wanted));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].code, code(4));
  EXPECT_LT(norm(found[0].centre - centre_of(wanted)), 0.15);
  EXPECT_TRUE(detector->detect(view(picture), Box{500, 500, 40, 40}).empty());
}

TEST_P(SquareMarkers, AreFoundUnderAHintThatIsHugeOrNoBoxAtAll) {
  const cv::Mat1b picture = shown(square({120, 90}, 60));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Box hint : {Box{-1e200, -1e200, 3e200, 3e200}, Box{nan, 0, 10, 10}, Box{0, 0, 0, 0}})
    EXPECT_EQ(detector->detect(view(picture), hint), detector->detect(view(picture)));
}

TEST_P(SquareMarkers, AreTheSameInGreyAndInColour) {
  const cv::Mat1b picture = shown(square({120, 90}, 60, 0.2));
  const auto gray = detector->detect(view(picture));
  ASSERT_EQ(gray.size(), 1u);
  EXPECT_EQ(detector->detect(view(bgr_of(picture))), gray);
}

TEST_P(SquareMarkers, AreTheSameInAPictureWhoseRowsAreFarApart) {
  const cv::Mat1b picture = shown(square({120, 90}, 60, 0.2));
  for (const int gap : {1, 37}) {
    cv::Mat1b wide(kPicture.height, kPicture.width + gap, std::uint8_t{77});
    picture.copyTo(wide.colRange(0, kPicture.width));
    EXPECT_EQ(detector->detect(view(wide.colRange(0, kPicture.width))), detector->detect(view(picture)));
  }
}

TEST_P(SquareMarkers, LeaveThePictureAsItWas) {
  for (const bool colour : {false, true}) {
    const cv::Mat1b gray = shown(square({120, 90}, 60));
    const cv::Mat picture = colour ? cv::Mat(bgr_of(gray)) : cv::Mat(gray);
    const cv::Mat before = picture.clone();
    detector->detect(view(picture));
    detector->detect(view(picture), Box{80, 50, 80, 80});
    EXPECT_EQ(cv::norm(before, picture, cv::NORM_L1), 0.0);
  }
}

TEST_P(SquareMarkers, AreNotSeenWhereThereAreNone) {
  EXPECT_TRUE(detector->detect(view(cv::Mat1b(180, 240, std::uint8_t{0}))).empty());
  cv::Mat3b noise(180, 240);
  cv::RNG(7).fill(noise, cv::RNG::UNIFORM, 0, 256);
  EXPECT_TRUE(detector->detect(view(noise)).empty());
}

TEST_P(SquareMarkers, AreNotSeenInPicturesOfAFewPixels) {
  for (const cv::Size size : {cv::Size{1, 1}, cv::Size{1, 300}, cv::Size{300, 1}, cv::Size{3, 5},
                              cv::Size{9, 9}, cv::Size{10, 10}, cv::Size{12, 40}, cv::Size{16, 16}})
    EXPECT_TRUE(detector->detect(view(cv::Mat1b(size, std::uint8_t{200}))).empty()) << size;
}

TEST_P(SquareMarkers, CannotBeLookedForInAnEmptyPicture) { EXPECT_THROW(detector->detect(Image{}), Error); }

TEST_P(SquareMarkers, AreNotPrintedBeyondTheLastOne) {
  EXPECT_THROW(GetParam().cells(-1), Error);
  EXPECT_THROW(GetParam().cells(100'000), Error);
}

Kind aruco_kind(const std::string& dictionary) {
  const ArucoOptions options{.dictionary = dictionary};
  return {"aruco" + dictionary, [options] { return aruco_detector(options); },
          [dictionary](int id) { return aruco_cells(dictionary, id); }, "aruco" + dictionary};
}

Kind apriltag_kind(const std::string& family) {
  const ApriltagOptions options{.family = family};
  return {family, [options] { return apriltag_detector(options); },
          [family](int id) { return apriltag_cells(family, id); }, "april" + family};
}

INSTANTIATE_TEST_SUITE_P(Detectors, SquareMarkers,
                         testing::Values(aruco_kind("6x6_250"), aruco_kind("4x4_50"),
                                         apriltag_kind("tag36h11"), apriltag_kind("tag25h9"),
                                         apriltag_kind("tagStandard41h12")),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace relock
