#include "detectors/ring_paper.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "core/error.h"
#include "core/opencv.h"
#include "core/stage.h"
#include "tests/detectors/drawn_rings.h"
#include "tests/detectors/rendered_marker.h"

namespace relock {
namespace {

RingPaperOptions with(const std::map<std::string, std::string>& given) {
  return ring_paper_options(Options("ring-paper", ring_paper_option_list(), given));
}

std::vector<std::string> codes(const Sightings& found) {
  std::vector<std::string> all;
  for (const Sighting& one : found) all.push_back(to_string(*one.code));
  std::sort(all.begin(), all.end());
  return all;
}
using Codes = std::vector<std::string>;

constexpr double kDegree = std::numbers::pi / 180;

TEST(RingPaperOptions, WithoutAnyGivenAreTheDefaultsThatAreListed) {
  const RingPaperOptions read = with({});
  EXPECT_EQ(read, RingPaperOptions{});
}

TEST(RingPaperOptions, RefuseWhatCannotBe) {
  EXPECT_THROW(with({{"kernel_px", "30"}}), Error);
  EXPECT_THROW(with({{"bits", "7"}}), Error);
  EXPECT_THROW(with({{"geometry", "0.2-0.1"}}), Error);
  EXPECT_THROW(with({{"distance", "far"}}), Error);
  EXPECT_THROW(with({{"threshold", "0"}}), Error);
}

TEST(RingPaper, TellsEveryCodeApartAtEveryTrainingOrientation) {
  const auto detector = ring_paper_detector({});
  for (const std::string& bits : all_ring_bits(2)) {
    cv::Mat1b sharp(190, 190, std::uint8_t{128});
    draw_rings(sharp, {paper_ring_geometry(), bits}, {94.7, 95.2}, 100);
    for (int degrees = 0; degrees < 360; degrees += 10) {
      cv::Mat1b picture = blurred(sharp, {degrees * kDegree, 27});
      add_noise(picture, 2, 1);
      const auto found = detector->detect(view(picture));
      ASSERT_EQ(codes(found), Codes{"ring2:" + bits}) << degrees;
      EXPECT_NEAR(norm(found[0].centre - Vec2{94.7, 95.2}), 0, 3) << bits << " " << degrees;
      EXPECT_EQ(found[0].confidence, 1);
    }
  }
}

TEST(RingPaper, FindsTheCentreAndTheCircleOfTheOutermostRing) {
  const auto found = ring_paper_detector({})->detect(view(blurred_rings("01", 120, {})));
  ASSERT_EQ(found.size(), 1u);
  const auto& circle = std::get<Ellipse>(found[0].outline);
  EXPECT_NEAR(norm(found[0].centre - Vec2{159.7, 160.2}), 0, 0.5);
  EXPECT_EQ(circle.centre, found[0].centre);
  EXPECT_EQ(found[0].centre_kind, CentreKind::outline);
  EXPECT_NEAR(circle.semi_major, 60, 0.5);
  EXPECT_EQ(circle.semi_minor, circle.semi_major);
  EXPECT_FALSE(found[0].blur);
}

/// Turned by a quarter, a point (x, y) of a square picture comes to (side - 1 - y, x).
TEST(RingPaper, SeesTheSameMarkerWhenPictureAndBlurTurnByAQuarter) {
  const auto detector = ring_paper_detector({});
  for (const double degrees : {10.0, 37.0, 77.0}) {
    const cv::Mat1b picture = blurred_rings("10", 110, {degrees * kDegree, 35}, 241);
    cv::Mat1b turned;
    cv::rotate(picture, turned, cv::ROTATE_90_CLOCKWISE);
    const auto a = detector->detect(view(picture)), b = detector->detect(view(turned));
    ASSERT_EQ(a.size(), 1u);
    ASSERT_EQ(b.size(), 1u);
    EXPECT_EQ(a[0].code, b[0].code);
    EXPECT_EQ(a[0].confidence, b[0].confidence);
    // Not to the last digit: the profile is read from its other end, and sums of floats depend on their order.
    EXPECT_NEAR(norm(Vec2{240 - a[0].centre.y, a[0].centre.x} - b[0].centre), 0, 0.6);
    EXPECT_NEAR(size_of(a[0].outline), size_of(b[0].outline), 0.6);
  }
}

TEST(RingPaper, FindsNothingOnWhatIsNoMarker) {
  const auto detector = ring_paper_detector({});
  for (const int level : {0, 1, 128, 255})
    EXPECT_TRUE(detector->detect(view(cv::Mat1b(240, 320, static_cast<std::uint8_t>(level)))).empty())
        << level;
  for (const double deviation : {1.0, 2.0, 20.0, 100.0}) {
    cv::Mat1b noise(240, 320, std::uint8_t{128});
    add_noise(noise, deviation, 7);
    EXPECT_TRUE(detector->detect(view(noise)).empty()) << deviation;
  }
  for (const int cell : {4, 11, 20, 40}) {
    cv::Mat1b board(240, 320);
    for (int y = 0; y < board.rows; ++y)
      for (int x = 0; x < board.cols; ++x) board(y, x) = (x / cell + y / cell) % 2 ? 255 : 0;
    EXPECT_TRUE(detector->detect(view(board)).empty()) << cell;
  }
}

TEST(RingPaper, FindsSeveralMarkersInOnePicture) {
  cv::Mat1b picture(480, 640, std::uint8_t{128});
  const std::vector<std::pair<std::string, Vec2>> markers{
      {"00", {90, 90}}, {"01", {550, 80}}, {"11", {330, 380}}};
  for (const auto& [bits, at] : markers) draw_rings(picture, {paper_ring_geometry(), bits}, at, 90);
  picture = blurred(picture, {1, 25});
  const auto found = ring_paper_detector({})->detect(view(picture));
  EXPECT_EQ(codes(found), (Codes{"ring2:00", "ring2:01", "ring2:11"}));
  for (const auto& [bits, at] : markers)
    EXPECT_TRUE(std::any_of(found.begin(), found.end(), [&, b = bits, p = at](const Sighting& s) {
      return s.code->value == b && norm(s.centre - p) < 2;
    })) << bits;
}

TEST(RingPaper, TakesMarkersForOneClusterWithinTheDistanceAndForTwoWithASmallerOne) {
  cv::Mat1b picture(200, 420, std::uint8_t{128});
  draw_rings(picture, {paper_ring_geometry(), "01"}, {110, 100}, 60);
  draw_rings(picture, {paper_ring_geometry(), "10"}, {310, 100}, 60);
  EXPECT_NE(codes(ring_paper_detector(with({{"linkage_px", "1000"}}))->detect(view(picture))),
            (Codes{"ring2:01", "ring2:10"}));
  EXPECT_EQ(codes(ring_paper_detector(with({{"linkage_px", "60"}}))->detect(view(picture))),
            (Codes{"ring2:01", "ring2:10"}));
}

TEST(RingPaper, ReadsInvertedMarkersWhenItIsToldTo) {
  for (const std::string& bits : all_ring_bits(2)) {
    RingMarker marker{paper_ring_geometry(), bits};
    marker.geometry.inverted = true;
    cv::Mat1b picture(240, 240, std::uint8_t{128});
    draw_rings(picture, marker, {120, 119}, 100);
    picture = blurred(picture, {0.4, 30});
    EXPECT_EQ(codes(ring_paper_detector(with({{"inverted", "true"}}))->detect(view(picture))),
              Codes{"ring2:" + bits});
    EXPECT_TRUE(ring_paper_detector({})->detect(view(picture)).empty());
  }
}

TEST(RingPaper, ReadsOneTwoAndThreeBits) {
  for (const int bits : {1, 2, 3}) {
    const auto detector = ring_paper_detector(with({{"bits", std::to_string(bits)}}));
    for (const std::string& code : all_ring_bits(bits))
      for (const BlurEstimate blur : {BlurEstimate{0, 0}, BlurEstimate{2, 25}})
        EXPECT_EQ(codes(detector->detect(view(blurred_rings(code, 120, blur, 200)))),
                  Codes{ring_family(bits) + ":" + code})
            << blur.length_px;
  }
}

TEST(RingPaper, ReadsTheGeometryItIsTold) {
  const auto detector = ring_paper_detector(with({{"geometry", "even"}}));
  for (const std::string& bits : all_ring_bits(2)) {
    cv::Mat1b picture(240, 240, std::uint8_t{128});
    draw_rings(picture, {even_ring_geometry(2), bits}, {120, 119}, 120);
    EXPECT_EQ(codes(detector->detect(view(blurred(picture, {0.4, 25})))), Codes{"ring2:" + bits});
  }
}

TEST(RingPaper, SeesInColourWhatItSeesInGrey) {
  const cv::Mat1b picture = blurred_rings("11", 90, {0.3, 20}, 200);
  const auto detector = ring_paper_detector({});
  EXPECT_EQ(detector->detect(view(bgr_of(picture))), detector->detect(view(picture)));
  EXPECT_EQ(detector->detect(view(picture)).size(), 1u);
}

TEST(RingPaper, LooksWhereItIsTold) {
  cv::Mat1b picture(300, 640, std::uint8_t{128});
  draw_rings(picture, {paper_ring_geometry(), "01"}, {130, 150}, 90);
  draw_rings(picture, {paper_ring_geometry(), "10"}, {510, 150}, 90);
  const auto detector = ring_paper_detector({});
  EXPECT_EQ(detector->detect(view(picture)).size(), 2u);
  const auto found = detector->detect(view(picture), Box{440, 80, 140, 140});
  ASSERT_EQ(codes(found), Codes{"ring2:10"});
  EXPECT_NEAR(norm(found[0].centre - Vec2{510, 150}), 0, 1);
  EXPECT_TRUE(detector->detect(view(picture), Box{9000, 80, 140, 140}).empty());
  EXPECT_TRUE(detector->detect(view(picture), Box{-900, -80, 14, 14}).empty());
}

TEST(RingPaper, TakesPicturesThatNoMarkerFitsInto) {
  const auto detector = ring_paper_detector({});
  for (const Size size : {Size{1, 1}, Size{2, 1}, Size{1, 40}, Size{7, 7}, Size{54, 30}, Size{2000, 3}})
    for (const int level : {0, 77, 255}) {
      cv::Mat1b picture(size.height, size.width, static_cast<std::uint8_t>(level));
      add_noise(picture, 30, 2);
      EXPECT_TRUE(detector->detect(view(picture)).empty()) << size.width << "x" << size.height;
    }
  EXPECT_THROW(detector->detect(Image{}), Error);
}

TEST(RingPaper, GivesTheSameWhateverWasShownBefore) {
  const auto detector = ring_paper_detector({}), fresh = ring_paper_detector({});
  const cv::Mat1b one = blurred_rings("01", 80, {0.3, 20}, 180),
                  other = blurred_rings("10", 120, {1, 30}, 260);
  const Sightings first = detector->detect(view(one));
  detector->detect(view(other));
  EXPECT_EQ(detector->detect(view(one)), first);
  EXPECT_EQ(fresh->detect(view(one)), first);
}

Stage stage_called(const std::vector<Stage>& stages, const std::string& name) {
  for (const Stage& stage : stages)
    if (stage.name == name) return stage;
  throw Error("no stage " + name);
}

TEST(RingPaper, ShowsItsStagesInTheOrderOfItsWork) {
  const auto detector = ring_paper_detector({});
  auto& explaining = dynamic_cast<ExplainingDetector&>(*detector);
  const cv::Mat1b picture = blurred_rings("01", 100, {0.3, 30}, 220);
  const std::vector<Stage> stages = explaining.explain(view(picture));
  Codes names;
  for (const Stage& stage : stages) {
    names.push_back(stage.name);
    EXPECT_FALSE(stage.sentence.empty());
    if (const auto* shown = std::get_if<Picture>(&stage.shown)) {
      EXPECT_EQ(shown->size, (Size{picture.cols, picture.rows}));
    }
  }
  EXPECT_EQ(names,
            (Codes{"filter", "components", "clusters", "direction", "profile", "classification", "answer"}));
  const Chart profile = std::get<Chart>(stage_called(stages, "profile").shown);
  EXPECT_EQ(profile.curves.size(), 3u);
  const Chart nearest = std::get<Chart>(stage_called(stages, "classification").shown);
  ASSERT_EQ(nearest.curves.size(), 6u);  // the profile and its five neighbours
  EXPECT_EQ(nearest.curves[1].name.substr(0, 2), "01");
}

TEST(RingPaper, ShowsStagesOfPicturesWithNothingInThemToo) {
  const auto detector = ring_paper_detector({});
  auto& explaining = dynamic_cast<ExplainingDetector&>(*detector);
  cv::Mat1b noise(120, 160, std::uint8_t{128});
  add_noise(noise, 50, 3);
  for (const cv::Mat1b& picture :
       {cv::Mat1b(120, 160, std::uint8_t{255}), noise, cv::Mat1b(1, 1, std::uint8_t{9})})
    EXPECT_EQ(explaining.explain(view(picture)).back().name, "answer");
  EXPECT_EQ(explaining.explain(view(noise), Box{9000, 0, 5, 5}).back().name, "answer");
}

}  // namespace
}  // namespace relock
