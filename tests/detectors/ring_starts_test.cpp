#include "detectors/ring/starts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "detectors/ring/coarse_fit.h"
#include "detectors/ring/finder.h"
#include "tests/detectors/drawn_ring.h"
#include "tests/detectors/drawn_rings.h"

namespace relock::ring {
namespace {

cv::Mat1b drawn_alone(const DrawnRing& ring) {
  cv::Mat1b picture(260, 300, std::uint8_t{128});
  draw(picture, {paper_ring_geometry(), "01"}, ring);
  add_noise(picture, 2, 1);
  return picture;
}

TEST(RingStarts, OneIsWithinHalfARingOfTheTruth) {
  // Of the geometry "paper" the narrowest ring takes 0.14 of the radius.
  constexpr double kHalfRing = 0.07;
  for (const Vec2 blur : {Vec2{0, 0}, Vec2{12, 5}, Vec2{0, 35}, Vec2{45, 20}}) {
    const DrawnRing ring{{148.3, 131.6}, 60, blur};
    Pyramid pyramid;
    const cv::Mat1b picture = drawn_alone(ring);
    pyramid.build(picture);
    CandidateFinder finder(paper_ring_geometry());
    const auto& candidates = finder.find(pyramid);
    ASSERT_FALSE(candidates.empty());
    const LocalBlur local = local_blur(picture, {ring.centre.x, ring.centre.y}, 57);
    double nearest = 1e9;
    for (const View& start : starts(candidates.front(), finder.chords(), local, 300)) {
      const Eigen::Vector2d off = start.centre - Eigen::Vector2d(ring.centre.x, ring.centre.y);
      const Eigen::Vector2d moved(blur.x, blur.y);
      const double shape = (start.shape() * ring.radius_px - Eigen::Matrix2d::Identity()).norm();
      const double length = std::min((start.blur - moved).norm(), (start.blur + moved).norm());
      nearest = std::min(nearest, std::max({off.norm() / 60, shape / 2, length / 60 / 2}));
    }
    EXPECT_LT(nearest, kHalfRing) << blur.x << ", " << blur.y;
  }
}

TEST(RingStarts, TheLikeliestIsFirstAndAFitFromTheBestComesHome) {
  RingModel model(paper_ring_geometry());
  Fitter fitter(model);
  for (const Vec2 blur : {Vec2{0, 0}, Vec2{30, 25}, Vec2{60, -10}}) {
    const DrawnRing ring{{148.3, 131.6}, 60, blur};
    const cv::Mat1b picture = drawn_alone(ring);
    Pyramid pyramid;
    pyramid.build(picture);
    CandidateFinder finder(paper_ring_geometry());
    const Candidate& candidate = finder.find(pyramid).front();
    const std::size_t level = first_level(candidate);
    const auto scored = scored_starts(candidate, finder.chords(), pyramid, level, model);
    for (std::size_t i = 1; i < scored.size(); ++i) EXPECT_GE(scored[i - 1].likeness, scored[i].likeness);
    const auto fit = fit_from_best(scored, candidate.best.code, pyramid, level, fitter);
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->view.centre.x(), ring.centre.x, 1);
    EXPECT_NEAR(fit->view.centre.y(), ring.centre.y, 1);
    EXPECT_NEAR(fit->view.radius(), 60, 1);
    EXPECT_NEAR(fit->view.blur.norm(), norm(blur), 5);
  }
}

TEST(RingStarts, GradientsShowTheBlursDirection) {
  for (const double direction : {0.1, 1.9}) {
    const Vec2 blur{50 * std::cos(direction), 50 * std::sin(direction)};
    const LocalBlur local = local_blur(drawn_alone({{148, 131}, 60, blur}), {148, 131}, 57);
    const double cosine = local.direction.dot(Eigen::Vector2d(std::cos(direction), std::sin(direction)));
    EXPECT_GT(std::abs(cosine), std::cos(0.06)) << direction;
    EXPECT_GT(local.coherence, 0.3) << direction;
  }
  EXPECT_LT(local_blur(drawn_alone({{148, 131}, 60}), {148, 131}, 57).coherence, 0.1);
}

TEST(RingStarts, NoGradientsNoDirection) {
  const LocalBlur none = local_blur(cv::Mat1b(1, 1, std::uint8_t{3}), {0, 0}, 5);
  EXPECT_EQ(none.coherence, 0);
  EXPECT_NEAR(none.direction.norm(), 1, 1e-12);
}

}  // namespace
}  // namespace relock::ring
