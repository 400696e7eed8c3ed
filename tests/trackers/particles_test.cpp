#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "core/opencv.h"
#include "tests/trackers/blurred_world.h"
#include "trackers/particles/filter.h"
#include "trackers/particles/proposal.h"
#include "trackers/particles/sampling.h"

namespace relock::particles {
namespace {

constexpr Vec2 kSize{BlurredWorld::kWidth, BlurredWorld::kHeight};
constexpr Grid kGrid{20, 18};

Eigen::VectorXf look(const cv::Mat& picture, const State& state, Vec2 size = kSize) {
  Sampling sampling(kGrid, size);
  sampling.show(view(picture), state.scale);
  Eigen::VectorXf values(kGrid.size());
  sampling.read(state, values);
  return values;
}

/// Grey rises by 0.2 a pixel to the right and 0.3 downwards.
cv::Mat1b slope() {
  cv::Mat1b picture(300, 400);
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 0; x < picture.cols; ++x) picture(y, x) = cv::saturate_cast<std::uint8_t>(0.2 * x + 0.3 * y);
  return picture;
}

TEST(Sampling, ReadsTheGreyValueAtEachSamplesPlace) {
  for (const double scale : {0.2, 0.5, 1.0, 1.7})
    for (const double rotation : {0.0, 0.4, -1.2}) {
      const State state{.centre = {200.3, 150.8}, .scale = scale, .aspect = 1.1, .rotation_rad = rotation};
      const Eigen::VectorXf values = look(slope(), state);
      for (int i = 0; i < kGrid.size(); i += 7) {
        const int column = i % kGrid.columns, row = i / kGrid.columns;
        const Vec2 at = state.centre + carried(state, {((column + 0.5) / kGrid.columns - 0.5) * kSize.x,
                                                       ((row + 0.5) / kGrid.rows - 0.5) * kSize.y});
        EXPECT_NEAR(255 * values[i], 0.2 * at.x + 0.3 * at.y, 0.7) << "scale " << scale << ", sample " << i;
      }
    }
}

TEST(Sampling, SeesTheSameInAPictureOfTwiceTheSize) {
  const cv::Mat1b picture = BlurredWorld(1).picture(BlurredWorld::kMiddle);
  cv::Mat1b larger;
  cv::resize(picture, larger, {}, 2, 2, cv::INTER_LINEAR);
  Eigen::VectorXf one = look(picture, {.centre = BlurredWorld::kMiddle});
  Eigen::VectorXf two = look(larger, {.centre = 2.0 * BlurredWorld::kMiddle + Vec2{0.5, 0.5}}, 2.0 * kSize);
  whiten(one), whiten(two);
  EXPECT_GT(one.dot(two), 0.999F);
}

TEST(Observations, AreOfMeanZeroAndLengthOneOrNotUsable) {
  const cv::Mat1b picture = BlurredWorld(1).picture(BlurredWorld::kMiddle);
  Sampling sampling(kGrid, kSize);
  sampling.show(view(picture), 1);
  const std::vector<State> states{
      {.centre = BlurredWorld::kMiddle}, {.centre = {-5, 10}}, {.centre = {-400, 10}}, {.centre = {NAN, 3}}};
  Observations seen;
  sampling.observe(states, seen);
  EXPECT_EQ(seen.usable, (std::vector<std::uint8_t>{1, 1, 0, 0}));
  for (const Eigen::Index i : {0, 1}) {
    EXPECT_NEAR(seen.look.col(i).mean(), 0, 1e-6);
    EXPECT_NEAR(seen.look.col(i).norm(), 1, 1e-5);
  }
  sampling.show(view(cv::Mat1b(320, 480, std::uint8_t{77})), 1);
  sampling.observe(states, seen);
  EXPECT_EQ(seen.usable, (std::vector<std::uint8_t>{0, 0, 0, 0}));
}

TEST(Resampling, DrawsEveryParticleInProportionToItsWeight) {
  std::vector<State> particles(100);
  std::vector<double> weights(100, 0);
  for (std::size_t i = 0; i < 100; ++i) particles[i].centre.x = static_cast<double>(i);
  weights[10] = 0.2, weights[40] = 0.5, weights[99] = 0.1;
  Random random(3);
  const auto drawn = resampled(weights, particles, random);
  const auto times = [&](double which) {
    return std::count_if(drawn.begin(), drawn.end(), [&](const State& s) { return s.centre.x == which; });
  };
  EXPECT_EQ(drawn.size(), 100u);
  EXPECT_NEAR(static_cast<double>(times(10)), 25, 1);
  EXPECT_NEAR(static_cast<double>(times(40)), 62.5, 1);
  EXPECT_NEAR(static_cast<double>(times(99)), 12.5, 1);
  EXPECT_EQ(times(10) + times(40) + times(99), 100);
}

/// Where 2000 particles at the last place go.
std::vector<State> proposed(const Motion& motion, const ProposalOptions& options,
                            std::optional<Hint> hint = {}) {
  std::vector<State> particles(2000, motion.last);
  Random random(5);
  propose(motion, hint, {.position_sigma = 0.02}, options, kSize, particles, random);
  return particles;
}

template <class Where>
double share(const std::vector<State>& particles, const Where& where) {
  return static_cast<double>(std::count_if(particles.begin(), particles.end(), where)) /
         static_cast<double>(particles.size());
}

TEST(Proposal, SendsParticlesToBothSidesAlongTheBlur) {
  const double angle = 0.6;
  const Vec2 along{std::cos(angle), std::sin(angle)}, across{-along.y, along.x};
  const Motion motion{.last = {.centre = {200, 150}}, .blur = BlurEstimate{angle, 30}};
  const auto particles = proposed(motion, {.kappa = 1.2, .lobe_share = 0.6, .lobe_spread = 0.1});
  const auto there = [&](const State& s) {
    return std::abs(dot(s.centre - motion.last.centre, along) - 36) < 15;
  };
  const auto back = [&](const State& s) {
    return std::abs(dot(s.centre - motion.last.centre, along) + 36) < 15;
  };
  const auto off = [&](const State& s) { return std::abs(dot(s.centre - motion.last.centre, across)) > 8; };
  EXPECT_NEAR(share(particles, there), 0.3, 0.04);
  EXPECT_NEAR(share(particles, back), 0.3, 0.04);
  EXPECT_EQ(share(particles, off), 0);
}

TEST(Proposal, KnowsNoLobesAfterASharpFrameOrWhenToldNotTo) {
  const auto far = [](const State& s) { return norm(s.centre - Vec2{200, 150}) > 10; };
  const Motion sharp{.last = {.centre = {200, 150}}};
  const Motion blurred{.last = {.centre = {200, 150}}, .blur = BlurEstimate{0, 30}};
  EXPECT_EQ(share(proposed(sharp, {}), far), 0);
  EXPECT_EQ(share(proposed(blurred, {.blur_lobes = false}), far), 0);
}

TEST(Proposal, GoesOnAtTheLastVelocityWhenToldTo) {
  const Motion motion{.last = {.centre = {200, 150}}, .velocity = {40, 0}};
  const auto ahead = [](const State& s) { return norm(s.centre - Vec2{240, 150}) < 20; };
  EXPECT_NEAR(
      share(proposed(motion, {.velocity = true, .velocity_share = 0.8, .velocity_spread = 0.1}), ahead), 0.8,
      0.04);
  EXPECT_EQ(share(proposed(motion, {.velocity = false}), ahead), 0);
}

TEST(Proposal, FollowsAHintAsWidelyAsItIsUnsure) {
  const Motion motion{.last = {.centre = {200, 150}}};
  const Box prior = unturned_box({.centre = {300, 80}, .scale = 1.5}, kSize);
  for (const double sigma : {0.0, 25.0}) {
    double square = 0;
    int count = 0;
    for (const State& s : proposed(motion, {}, Hint{prior, sigma})) {
      if (norm(s.centre - motion.last.centre) < 10) continue;
      EXPECT_NEAR(s.scale, 1.5, 0.1);
      square += dot(s.centre - Vec2{300, 80}, s.centre - Vec2{300, 80}) / 2;
      ++count;
    }
    EXPECT_NEAR(count, 1600, 20);
    const double walk = 0.02 * 1.5 * kSize.x;
    EXPECT_NEAR(std::sqrt(square / count), std::hypot(sigma, walk), 0.1 * std::hypot(sigma, walk));
  }
}

}  // namespace
}  // namespace relock::particles
