#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "core/random.h"
#include "detectors/ring/finder.h"
#include "tests/detectors/drawn_ring.h"

namespace relock::ring {
namespace {

std::vector<Candidate> candidates(const cv::Mat1b& picture,
                                  const RingGeometry& geometry = paper_ring_geometry()) {
  CandidateFinder finder(geometry);
  Pyramid pyramid;
  pyramid.build(picture);
  return finder.find(pyramid);
}

cv::Mat1b with_noise(const cv::Mat1b& picture, double sigma, std::uint64_t seed) {
  Random random(seed);
  cv::Mat1b noisy = picture.clone();
  for (auto& pixel : noisy) pixel = cv::saturate_cast<std::uint8_t>(pixel + sigma * random.normal());
  return noisy;
}

cv::Mat1b drawn(const RingMarker& marker, const DrawnRing& ring, cv::Size size = {320, 240}) {
  cv::Mat1b picture(size, std::uint8_t{128});
  draw(picture, marker, ring);
  return picture;
}

TEST(RingCandidates, TheFirstIsADrawnMarkersMiddleRadiusAndCode) {
  for (const int bits : {1, 2, 3, 4}) {
    const auto codes = all_ring_bits(bits);
    for (std::size_t code = 0; code < codes.size(); ++code) {
      const RingMarker marker{ring_geometry("paper", bits), codes[code]};
      const DrawnRing ring{{150.3, 118.6}, 62};
      const auto found = candidates(with_noise(drawn(marker, ring), 2, code), marker.geometry);
      ASSERT_FALSE(found.empty()) << codes[code];
      const Candidate& first = found.front();
      EXPECT_LT(norm(first.best.middle - ring.centre), 2) << codes[code];
      EXPECT_NEAR(first.best.radius_px, 62, 2) << codes[code];
      EXPECT_EQ(first.best.code, code);
      EXPECT_LT(first.best.blur, 0.3);
      EXPECT_EQ(first.directions, 8) << codes[code];
    }
  }
}

TEST(RingCandidates, SmallMarkersAreFound) {
  const RingMarker marker{paper_ring_geometry(), "01"};
  const DrawnRing ring{{150.3, 118.6}, 10};
  const auto found = candidates(with_noise(drawn(marker, ring), 2, 1));
  ASSERT_FALSE(found.empty());
  EXPECT_LT(norm(found.front().best.middle - ring.centre), 1);
  EXPECT_NEAR(found.front().best.radius_px, 10, 0.7);
}

TEST(RingCandidates, TheLineSquareToABlurTellsItsLength) {
  const RingMarker marker{paper_ring_geometry(), "01"};
  for (const double length : {30.0, 60.0, 90.0}) {
    const DrawnRing ring{{160, 120}, 60, {length, 0}};
    const auto found = candidates(with_noise(drawn(marker, ring), 2, 1));
    ASSERT_FALSE(found.empty()) << length;
    const Chord& best = found.front().best;
    EXPECT_NEAR(best.middle.y, 120, 1) << length;
    EXPECT_NEAR(best.middle.x, 160, 0.3 * 60) << length;
    EXPECT_GT(std::abs(best.along.y), std::cos(0.5)) << length;
    EXPECT_NEAR(best.radius_px, 60, 4) << length;
    EXPECT_EQ(best.code, 1U) << length;
    EXPECT_NEAR(best.blur, length / 60, 0.45) << length;
  }
}

struct Change {
  const char* name;
  cv::Mat1b (*of_picture)(const cv::Mat1b&);
  Vec2 (*of_point)(Vec2, const cv::Mat1b&);
};

const Change kChanges[] = {
    {"mirrored",
     [](const cv::Mat1b& p) {
       cv::Mat1b q;
       cv::flip(p, q, 1);
       return q;
     },
     [](Vec2 v, const cv::Mat1b& p) {
       return Vec2{p.cols - 1 - v.x, v.y};
     }},
    {"transposed",
     [](const cv::Mat1b& p) {
       cv::Mat1b q;
       cv::transpose(p, q);
       return q;
     },
     [](Vec2 v, const cv::Mat1b&) {
       return Vec2{v.y, v.x};
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
    {"darker and of less contrast",
     [](const cv::Mat1b& p) {
       cv::Mat1b q;
       p.convertTo(q, -1, 0.6, 10);
       return q;
     },
     [](Vec2 v, const cv::Mat1b&) { return v; }},
};

TEST(RingCandidates, FollowThePictureWhenItIsTurnedMirroredTransposedOrDarkened) {
  const RingMarker marker{paper_ring_geometry(), "10"};
  for (const Vec2 blur : {Vec2{0, 0}, Vec2{30, 18}}) {
    const cv::Mat1b picture = with_noise(drawn(marker, {{140, 124}, 55, blur}), 2, 5);
    const auto before = candidates(picture);
    ASSERT_FALSE(before.empty());
    for (const Change& change : kChanges) {
      const auto after = candidates(change.of_picture(picture));
      ASSERT_FALSE(after.empty()) << change.name;
      const Vec2 expected = change.of_point(before.front().best.middle, picture);
      EXPECT_LT(norm(after.front().best.middle - expected), blur == Vec2{} ? 2 : 6) << change.name;
      EXPECT_NEAR(after.front().best.radius_px, before.front().best.radius_px, 2) << change.name;
      EXPECT_EQ(after.front().best.code, before.front().best.code) << change.name;
    }
  }
}

// Some lines across a checkerboard are symmetric bars, too; a marker's own are more than .98 alike.
TEST(RingCandidates, AreNoneInABlankPictureAndNoiseAndPoorOnACheckerboard) {
  EXPECT_TRUE(candidates(cv::Mat1b(240, 320, std::uint8_t{128})).empty());
  EXPECT_TRUE(candidates(with_noise(cv::Mat1b(240, 320, std::uint8_t{128}), 4, 3)).empty());
  cv::Mat1b checkers(240, 320);
  for (int y = 0; y < checkers.rows; ++y)
    for (int x = 0; x < checkers.cols; ++x) checkers(y, x) = (x / 16 + y / 16) % 2 == 0 ? 40 : 210;
  for (const Candidate& candidate : candidates(checkers)) EXPECT_LT(candidate.best.likeness, 0.97);
}

TEST(RingCandidates, AMovingMarkerThatTouchesThePicturesEdgeIsFound) {
  const RingMarker marker{paper_ring_geometry(), "01"};
  const DrawnRing ring{{160, 65}, 60, {40, 0}};
  const auto found = candidates(with_noise(drawn(marker, ring), 2, 1));
  ASSERT_FALSE(found.empty());
  EXPECT_LT(norm(found.front().best.middle - ring.centre), 15);
  EXPECT_NEAR(found.front().best.radius_px, 60, 4);
}

// Lines through it that begin and end in what is around are symmetric, too, and of a larger marker.
TEST(RingCandidates, ASmallMarkerBetweenWhatLooksLikeALargerOneIsOne) {
  cv::Mat1b picture(240, 320, std::uint8_t{40});
  for (const int radius : {40, 58}) cv::circle(picture, {150, 118}, radius, 200, 7, cv::LINE_AA);
  const RingMarker marker{paper_ring_geometry(), "01"};
  const DrawnRing ring{{153.3, 116.6}, 11};
  draw(picture, marker, ring);
  const auto found = candidates(with_noise(picture, 2, 1));
  EXPECT_TRUE(std::any_of(found.begin(), found.end(), [&](const Candidate& candidate) {
    return norm(candidate.best.middle - ring.centre) < 2 && std::abs(candidate.best.radius_px - 11) < 1.5 &&
           candidate.best.code == 1;
  }));
}

// A line beside the middle of a small marker misses its inner rings: a shorter chord of another code.
TEST(RingCandidates, ASmallMarkersLongestChordSaysItsCode) {
  for (const std::string& bits : all_ring_bits(2))
    for (const double shift : {0.0, 0.5, 1.0, 1.5}) {
      const RingMarker marker{even_ring_geometry(2), bits};
      const DrawnRing ring{{150 + shift, 118.3 - 0.7 * shift}, 12};
      const auto found = candidates(with_noise(drawn(marker, ring), 2, 1), marker.geometry);
      EXPECT_TRUE(std::any_of(found.begin(),
                              found.begin() + std::min<std::ptrdiff_t>(found.end() - found.begin(), 3),
                              [&](const Candidate& candidate) {
                                return all_ring_bits(2)[candidate.best.code] == bits &&
                                       norm(candidate.best.middle - ring.centre) < 2;
                              }))
          << bits << " " << shift;
    }
}

TEST(RingCandidates, AreNoneInPicturesTooSmallForAny) {
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(2, 1), cv::Size(3, 40), cv::Size(7, 7)})
    EXPECT_TRUE(candidates(cv::Mat1b(size, std::uint8_t{9})).empty());
}

TEST(RingCandidates, TheTrueOneIsFirstAmongShapesDrawnAroundIt) {
  const RingMarker marker{paper_ring_geometry(), "11"};
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    Random random(seed);
    cv::Mat1b picture(240, 320, std::uint8_t{120});
    for (int shape = 0; shape < 60; ++shape) {
      const cv::Point at(static_cast<int>(random.below(320)), static_cast<int>(random.below(240)));
      const cv::Point other(static_cast<int>(random.below(320)), static_cast<int>(random.below(240)));
      const cv::Scalar grey(static_cast<double>(random.below(256)));
      if (shape % 3 == 0) cv::line(picture, at, other, grey, 3, cv::LINE_AA);
      if (shape % 3 == 1)
        cv::circle(picture, at, 5 + static_cast<int>(random.below(30)), grey, -1, cv::LINE_AA);
      if (shape % 3 == 2) cv::rectangle(picture, {at, cv::Size(30, 18)}, grey, -1);
    }
    const DrawnRing ring{{100.0 + 100 * random.uniform(), 100.0 + 30 * random.uniform()}, 45};
    draw(picture, marker, ring);
    const auto found = candidates(with_noise(picture, 3, seed));
    ASSERT_FALSE(found.empty());
    EXPECT_LT(norm(found.front().best.middle - ring.centre), 3);
    EXPECT_EQ(found.front().best.code, 3U);
  }
}

TEST(RingCandidates, DoNotDependOnPicturesSeenBefore) {
  const RingMarker marker{paper_ring_geometry(), "01"};
  const cv::Mat1b picture = with_noise(drawn(marker, {{160, 120}, 50}), 3, 1);
  const cv::Mat1b other = with_noise(drawn(marker, {{80, 90}, 30, {20, 20}}, {200, 180}), 3, 2);
  CandidateFinder finder(marker.geometry);
  Pyramid pyramid;
  pyramid.build(other);
  finder.find(pyramid);
  pyramid.build(picture);
  const auto& again = finder.find(pyramid);
  const auto fresh = candidates(picture);
  ASSERT_EQ(again.size(), fresh.size());
  for (std::size_t i = 0; i < fresh.size(); ++i) {
    EXPECT_EQ(again[i].best.middle, fresh[i].best.middle);
    EXPECT_EQ(again[i].score, fresh[i].score);
    EXPECT_EQ(again[i].chords.size(), fresh[i].chords.size());
  }
}

TEST(RingCandidates, HaveEachLineOfOneSizeOnce) {
  const RingMarker marker{paper_ring_geometry(), "01"};
  const auto found = candidates(with_noise(drawn(marker, {{160, 120}, 50}), 3, 1));
  ASSERT_FALSE(found.empty());
  const auto& chords = found.front().chords;
  for (std::size_t i = 0; i < chords.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const bool same = chords[i].direction == chords[j].direction &&
                        norm(chords[i].middle - chords[j].middle) < 0.5 &&
                        std::abs(chords[i].radius_px - chords[j].radius_px) < 0.02 * chords[i].radius_px;
      EXPECT_FALSE(same) << i << " and " << j;
    }
}

}  // namespace
}  // namespace relock::ring
