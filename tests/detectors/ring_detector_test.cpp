#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/error.h"
#include "core/opencv.h"
#include "core/random.h"
#include "core/stage.h"
#include "detectors/ring.h"
#include "tests/detectors/drawn_ring.h"
#include "tests/detectors/drawn_rings.h"
#include "tests/detectors/rendered_marker.h"

namespace relock {
namespace {

RingOptions with(const std::map<std::string, std::string>& given) {
  return ring_options(Options("ring", ring_option_list(), given));
}

using Codes = std::vector<std::string>;
Codes codes(const Sightings& found) {
  Codes all;
  for (const Sighting& one : found) all.push_back(to_string(*one.code));
  std::sort(all.begin(), all.end());
  return all;
}

constexpr Vec2 kCentre{88.3, 81.6};

cv::Mat1b drawn(const RingMarker& marker, const DrawnRing& ring, Size size = {180, 165}) {
  cv::Mat1b picture(size.height, size.width, std::uint8_t{128});
  draw(picture, marker, ring);
  add_noise(picture, 2, 1);
  return picture;
}
cv::Mat1b drawn(const std::string& bits, Vec2 blur, double radius_px = 45) {
  return drawn({paper_ring_geometry(), bits}, {kCentre, radius_px, blur});
}

TEST(RingOptions, WithoutAnyGivenAreTheDefaultsThatAreListed) { EXPECT_EQ(with({}), RingOptions{}); }

TEST(RingOptions, RefuseWhatCannotBe) {
  EXPECT_THROW(with({{"bits", "7"}}), Error);
  EXPECT_THROW(with({{"bits", "0"}}), Error);
  EXPECT_THROW(with({{"geometry", "0.2-0.1"}}), Error);
  EXPECT_THROW(with({{"geometry", "0.18-0.33,0.41-0.55,0.855-1"}}), Error);  // that is one bit
  EXPECT_THROW(with({{"inverted", "maybe"}}), Error);
  EXPECT_THROW(with({{"min_diameter_px", "3"}}), Error);
  EXPECT_THROW(with({{"max_candidates", "0"}}), Error);
  EXPECT_THROW(ring_detector({.geometry = "0.2-0.1"}), Error);
}

TEST(RingDetector, ReadsEveryCodeSharpAndBlurredByMoreThanHalfADiameter) {
  const auto detector = ring_detector({});
  for (const std::string& bits : all_ring_bits(2))
    for (const Vec2 blur : {Vec2{0, 0}, Vec2{26, 15}, Vec2{-20, 45}}) {
      const auto found = detector->detect(view(drawn(bits, blur)));
      ASSERT_EQ(codes(found), Codes{"ring2:" + bits}) << norm(blur);
      const Sighting& one = found.front();
      EXPECT_EQ(one.centre_kind, CentreKind::projected);
      EXPECT_LT(norm(one.centre - kCentre), 0.2) << norm(blur);
      const auto& outline = std::get<Ellipse>(one.outline);
      EXPECT_NEAR(outline.semi_major, 45, 0.6) << norm(blur);
      EXPECT_NEAR(outline.semi_minor, 45, 0.6) << norm(blur);
      EXPECT_NEAR(one.blur->length_px, norm(blur), norm(blur) > 0 ? 1 : 3);
      if (norm(blur) > 0) {
        EXPECT_NEAR(std::cos(one.blur->direction_rad - std::atan2(blur.y, blur.x)) *
                        std::cos(one.blur->direction_rad - std::atan2(blur.y, blur.x)),
                    1, 1e-3);
      }
      EXPECT_GT(one.confidence, 0.6);
      EXPECT_LE(one.confidence, 1);
    }
}

struct Change {
  const char* name;
  cv::Mat1b (*of_picture)(const cv::Mat1b&);
  Vec2 (*of_point)(Vec2, const cv::Mat1b&);
};
const Change kChanges[] = {
    {"transposed",
     [](const cv::Mat1b& p) {
       cv::Mat1b q;
       cv::transpose(p, q);
       return q;
     },
     [](Vec2 v, const cv::Mat1b&) {
       return Vec2{v.y, v.x};
     }},
    {"mirrored",
     [](const cv::Mat1b& p) {
       cv::Mat1b q;
       cv::flip(p, q, 1);
       return q;
     },
     [](Vec2 v, const cv::Mat1b& p) {
       return Vec2{p.cols - 1 - v.x, v.y};
     }},
    {"turned by 90 degrees",
     [](const cv::Mat1b& p) {
       cv::Mat1b q;
       cv::rotate(p, q, cv::ROTATE_90_CLOCKWISE);
       return q;
     },
     [](Vec2 v, const cv::Mat1b& p) {
       return Vec2{p.rows - 1 - v.y, v.x};
     }},
    {"turned by 270 degrees",
     [](const cv::Mat1b& p) {
       cv::Mat1b q;
       cv::rotate(p, q, cv::ROTATE_90_COUNTERCLOCKWISE);
       return q;
     },
     [](Vec2 v, const cv::Mat1b& p) {
       return Vec2{v.y, p.cols - 1 - v.x};
     }},
    {"upside down",
     [](const cv::Mat1b& p) {
       cv::Mat1b q;
       cv::rotate(p, q, cv::ROTATE_180);
       return q;
     },
     [](Vec2 v, const cv::Mat1b& p) {
       return Vec2{p.cols - 1 - v.x, p.rows - 1 - v.y};
     }},
    {"brighter",
     [](const cv::Mat1b& p) {
       cv::Mat1b q;
       p.convertTo(q, -1, 1.15, 0);
       return q;
     },
     [](Vec2 v, const cv::Mat1b&) { return v; }},
    {"of less contrast",
     [](const cv::Mat1b& p) {
       cv::Mat1b q;
       p.convertTo(q, -1, 0.5, 40);
       return q;
     },
     [](Vec2 v, const cv::Mat1b&) { return v; }},
};

TEST(RingDetector, SeesTheSameMarkerInATransposedMirroredTurnedOrDimmerPicture) {
  const auto detector = ring_detector({});
  for (const Vec2 blur : {Vec2{0, 0}, Vec2{30, -18}, Vec2{-15, 40}}) {
    const cv::Mat1b picture = drawn("10", blur);
    const auto before = detector->detect(view(picture));
    ASSERT_EQ(codes(before), Codes{"ring2:10"});
    for (const Change& change : kChanges) {
      const cv::Mat1b changed = change.of_picture(picture);
      const auto after = detector->detect(view(changed));
      ASSERT_EQ(codes(after), Codes{"ring2:10"}) << change.name << " " << norm(blur);
      EXPECT_LT(norm(after[0].centre - change.of_point(before[0].centre, picture)), 0.2)
          << change.name << " " << norm(blur);
    }
  }
}

TEST(RingDetector, DoesNotTellWhetherTheExposureRanForwardsOrBackwards) {
  const auto detector = ring_detector({});
  for (const Vec2 blur : {Vec2{26, 15}, Vec2{-20, 45}}) {
    const auto forwards = detector->detect(view(drawn("01", blur)));
    const auto backwards = detector->detect(view(drawn("01", -1 * blur)));
    ASSERT_EQ(codes(forwards), Codes{"ring2:01"});
    ASSERT_EQ(codes(backwards), Codes{"ring2:01"});
    EXPECT_LT(norm(forwards[0].centre - backwards[0].centre), 0.05);
    EXPECT_NEAR(forwards[0].blur->direction_rad, backwards[0].blur->direction_rad, 0.005);
    EXPECT_NEAR(forwards[0].blur->length_px, backwards[0].blur->length_px, 0.1);
  }
}

TEST(RingDetector, ReadsSmallMarkersWhereverTheirPixelsFall) {
  for (const std::string geometry : {"paper", "even"}) {
    const auto detector = ring_detector({.geometry = geometry});
    for (const std::string& bits : all_ring_bits(2))
      for (const double shift : {0.0, 0.25, 0.5, 0.75, 1.25}) {
        const Vec2 centre{40 + shift, 41.3 - 0.8 * shift};
        const auto found =
            detector->detect(view(drawn({ring_geometry(geometry, 2), bits}, {centre, 12}, {80, 84})));
        ASSERT_EQ(codes(found), Codes{"ring2:" + bits}) << geometry << " " << shift;
        EXPECT_LT(norm(found[0].centre - centre), 0.1) << geometry << " " << shift;
      }
  }
}

TEST(RingDetector, ReadsMarkersOfWhichAPartIsOutOfThePicture) {
  const auto detector = ring_detector({});
  for (const std::string& bits : all_ring_bits(2))
    for (const Vec2 blur : {Vec2{0, 0}, Vec2{10, 25}}) {
      const auto found = detector->detect(view(drawn({paper_ring_geometry(), bits}, {{36.3, 82}, 45, blur})));
      ASSERT_EQ(codes(found), Codes{"ring2:" + bits}) << norm(blur);
      EXPECT_LT(norm(found[0].centre - Vec2{36.3, 82}), 0.3) << norm(blur);
    }
}

TEST(RingDetector, ReadsTiltedMarkersInPerspective) {
  RingMarker marker{paper_ring_geometry(), "01"};
  const cv::Mat1b straight = drawn(marker, {{199.5, 199.5}, 140}, {400, 400});
  const cv::Point2f from[] = {{59.5, 59.5}, {339.5, 59.5}, {339.5, 339.5}, {59.5, 339.5}};
  const cv::Point2f to[] = {{60, 62}, {168, 74}, {170, 168}, {52, 186}};
  const cv::Matx33d h = cv::getPerspectiveTransform(from, to);
  cv::Mat1b soft, tilted;
  cv::GaussianBlur(straight, soft, {}, 1.2);
  cv::warpPerspective(soft, tilted, h, {230, 230}, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  const auto found = ring_detector({})->detect(view(tilted));
  ASSERT_EQ(codes(found), Codes{"ring2:01"});
  const cv::Vec3d c = h * cv::Vec3d(199.5, 199.5, 1);
  EXPECT_LT(norm(found[0].centre - Vec2{c[0] / c[2], c[1] / c[2]}), 0.2);
  EXPECT_GT(norm(centre_of(found[0].outline) - found[0].centre), 0.3);
}

TEST(RingDetector, FindsTwoMarkersInOnePicture) {
  cv::Mat1b picture(220, 420, std::uint8_t{128});
  draw(picture, {paper_ring_geometry(), "01"}, {{105, 108}, 55, {20, 10}});
  draw(picture, {paper_ring_geometry(), "10"}, {{312, 110}, 40, {20, 10}});
  add_noise(picture, 2, 1);
  EXPECT_EQ(codes(ring_detector({})->detect(view(picture))), (Codes{"ring2:01", "ring2:10"}));
}

TEST(RingDetector, ReadsNoThirdCodeWhereTwoMarkersCross) {
  const auto detector = ring_detector({});
  for (const double apart : {10.0, 40.0, 70.0, 100.0}) {
    cv::Mat1b picture(220, 320, std::uint8_t{128});
    draw(picture, {paper_ring_geometry(), "01"}, {{110, 108}, 55});
    draw(picture, {paper_ring_geometry(), "10"}, {{110 + apart, 112}, 55});
    for (const std::string& code : codes(detector->detect(view(picture))))
      EXPECT_TRUE(code == "ring2:01" || code == "ring2:10") << apart << " " << code;
  }
}

TEST(RingDetector, ReadsOneToFourBits) {
  for (const int bits : {1, 2, 3, 4}) {
    const auto detector = ring_detector(with({{"bits", std::to_string(bits)}, {"geometry", "even"}}));
    const auto all = all_ring_bits(bits);
    for (std::size_t code = 0; code < all.size(); code += bits < 3 ? 1 : 5)
      EXPECT_EQ(codes(detector->detect(view(drawn({even_ring_geometry(bits), all[code]},
                                                  {{112.3, 104.6}, 62, {9, 12}}, {230, 210})))),
                Codes{ring_family(bits) + ":" + all[code]});
  }
}

TEST(RingDetector, ReadsInvertedMarkersWhenItIsToldTo) {
  RingMarker marker{paper_ring_geometry(), "10"};
  marker.geometry.inverted = true;
  const cv::Mat1b picture = drawn(marker, {kCentre, 45, {20, 9}});
  EXPECT_EQ(codes(ring_detector(with({{"inverted", "true"}}))->detect(view(picture))), Codes{"ring2:10"});
  EXPECT_TRUE(ring_detector({})->detect(view(picture)).empty());
}

TEST(RingDetector, LooksForNothingSmallerThanItIsTold) {
  const cv::Mat1b picture = drawn("01", {}, 25);
  EXPECT_EQ(ring_detector(with({{"min_diameter_px", "40"}}))->detect(view(picture)).size(), 1U);
  EXPECT_TRUE(ring_detector(with({{"min_diameter_px", "70"}}))->detect(view(picture)).empty());
}

TEST(RingDetector, ReadsNoWrongCodeOfAMarkerThatLeavesThePicture) {
  const auto detector = ring_detector({});
  for (const std::string& bits : all_ring_bits(2))
    for (const double x : {35.0, 15.0, -10.0, -30.0})
      for (const Vec2 blur : {Vec2{0, 0}, Vec2{10, 25}})
        for (const Sighting& one :
             detector->detect(view(drawn({paper_ring_geometry(), bits}, {{x, 82}, 45, blur}))))
          EXPECT_EQ(one.code->value, bits) << x;
}

TEST(RingDetector, FindsNothingOnWhatIsNoMarker) {
  const auto detector = ring_detector({});
  for (const int level : {0, 128, 255})
    EXPECT_TRUE(detector->detect(view(cv::Mat1b(240, 320, static_cast<std::uint8_t>(level)))).empty());
  for (const double deviation : {2.0, 20.0, 100.0}) {
    cv::Mat1b noise(240, 320, std::uint8_t{128});
    add_noise(noise, deviation, 7);
    EXPECT_TRUE(detector->detect(view(noise)).empty()) << deviation;
  }
  for (const int cell : {4, 11, 20, 40}) {
    cv::Mat1b board(240, 320), slope(240, 320);
    for (int y = 0; y < board.rows; ++y)
      for (int x = 0; x < board.cols; ++x) {
        board(y, x) = (x / cell + y / cell) % 2 ? 255 : 0;
        slope(y, x) = cv::saturate_cast<std::uint8_t>((x + y) % (cell * 8) * 255 / (cell * 8));
      }
    EXPECT_TRUE(detector->detect(view(board)).empty()) << cell;
    EXPECT_TRUE(detector->detect(view(slope)).empty()) << cell;
  }
}

/// Noise, shapes and pieces of markers.
cv::Mat1b any_picture(Random& random) {
  const auto below = [&](int n) { return static_cast<int>(random.below(static_cast<std::uint64_t>(n))); };
  const cv::Size size(1 + below(200), 1 + below(200));
  cv::Mat1b picture(size, static_cast<std::uint8_t>(below(256)));
  for (int shape = below(6); shape > 0; --shape)
    cv::circle(picture, {below(200), below(200)}, below(60), below(256), below(2) ? -1 : 1 + below(6));
  if (below(2))
    draw(picture, {paper_ring_geometry(), all_ring_bits(2)[random.below(4)]},
         {{200 * random.uniform(), 200 * random.uniform()},
          8 + 50 * random.uniform(),
          {16 * random.normal(), 16 * random.normal()}});
  add_noise(picture, 30 * random.uniform(), random.below(1000));
  return picture;
}

TEST(RingDetector, AnswersWellFormedWhateverItIsShown) {
  Random random(5);
  const auto detector = ring_detector({});
  for (int n = 0; n < 300; ++n) {
    const cv::Mat1b picture = any_picture(random);
    std::optional<Box> where;
    if (n % 3 == 0)
      where = Box{300 * random.uniform() - 50, 300 * random.uniform() - 50, 200 * random.uniform(),
                  200 * random.uniform()};
    for (const Sighting& one : detector->detect(view(picture), where)) {
      EXPECT_TRUE(std::isfinite(one.centre.x) && std::isfinite(one.centre.y)) << n;
      EXPECT_TRUE(well_formed(std::get<Ellipse>(one.outline))) << n;
      EXPECT_TRUE(one.confidence >= 0 && one.confidence <= 1) << n;
      EXPECT_TRUE(one.blur->direction_rad >= 0 && one.blur->direction_rad < 3.1416) << n;
      EXPECT_TRUE(std::isfinite(one.blur->length_px)) << n;
    }
  }
  EXPECT_THROW(detector->detect(Image{}), Error);
}

TEST(RingDetector, SeesInColourWhatItSeesInGrey) {
  const cv::Mat1b picture = drawn("11", {20, 5});
  const auto detector = ring_detector({});
  EXPECT_EQ(detector->detect(view(bgr_of(picture))), detector->detect(view(picture)));
  EXPECT_EQ(detector->detect(view(picture)).size(), 1U);
}

TEST(RingDetector, LooksWhereItIsTold) {
  cv::Mat1b picture(220, 420, std::uint8_t{128});
  draw(picture, {paper_ring_geometry(), "01"}, {{105, 108}, 45});
  draw(picture, {paper_ring_geometry(), "10"}, {{320.3, 110.6}, 45});
  const auto detector = ring_detector({});
  const auto found = detector->detect(view(picture), Box{270, 60, 100, 100});
  ASSERT_EQ(codes(found), Codes{"ring2:10"});
  EXPECT_LT(norm(found[0].centre - Vec2{320.3, 110.6}), 0.1);
  EXPECT_TRUE(detector->detect(view(picture), Box{9000, 80, 140, 140}).empty());
}

TEST(RingDetector, GivesTheSameWhateverWasShownBefore) {
  const cv::Mat1b one = drawn("01", {20, 9}), other = drawn("10", {3, 50}, 40);
  const auto detector = ring_detector({});
  const Sightings first = detector->detect(view(one));
  ASSERT_EQ(first.size(), 1U);
  detector->detect(view(other));
  EXPECT_EQ(detector->detect(view(one)), first);
  EXPECT_EQ(ring_detector({})->detect(view(one)), first);
}

TEST(RingDetector, ShowsItsStagesInTheOrderOfItsWork) {
  const auto detector = ring_detector({});
  auto& explaining = dynamic_cast<ExplainingDetector&>(*detector);
  Codes names;
  for (const Stage& stage : explaining.explain(view(drawn("01", {20, 9})))) {
    names.push_back(stage.name);
    EXPECT_FALSE(stage.sentence.empty());
    if (const auto* chart = std::get_if<Chart>(&stage.shown)) {
      EXPECT_EQ(chart->curves.size(), 3U);
    }
  }
  EXPECT_EQ(names, (Codes{"chords", "candidates", "starts", "fit", "rings", "answer"}));
}

TEST(RingDetector, ShowsStagesOfAnyPicture) {
  const auto detector = ring_detector({});
  auto& explaining = dynamic_cast<ExplainingDetector&>(*detector);
  Random random(6);
  for (int n = 0; n < 60; ++n) EXPECT_EQ(explaining.explain(view(any_picture(random))).back().name, "answer");
  EXPECT_EQ(explaining.explain(view(drawn("01", {})), Box{9000, 0, 5, 5}).back().name, "answer");
}

}  // namespace
}  // namespace relock
