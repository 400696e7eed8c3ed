#include "trackers/blut/tracker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <thread>

#include "core/error.h"
#include "core/opencv.h"
#include "tests/trackers/blurred_world.h"
#include "tests/trackers/moving_patch.h"
#include "trackers/blut/occlusion.h"
#include "trackers/ivt/tracker.h"
#include "trackers/opencv_tracker.h"

namespace relock {
namespace {

constexpr double kPi = std::numbers::pi;
const double kGate = 0.25 * std::sqrt(BlurredWorld::kWidth * BlurredWorld::kHeight);

BlutOptions l1_defaults() { return l1_options(Options("l1", l1_option_list(), {})); }

/// Share of the frames of a path in which the answer is within a quarter of the target's size.
double held(Tracker& tracker, std::uint64_t seed, double fastest, int frames) {
  const BlurredWorld world(seed);
  const BlurredPath path = blurred_path(frames, fastest, seed);
  const cv::Mat first = world.picture(path.centres[0]);
  tracker.start(frame_of(first, 0), BlurredWorld::box(path.centres[0]));
  int good = 0;
  for (int i = 1; i < frames; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const cv::Mat picture = world.picture(path.centres[at], path.blurs[at]);
    const auto seen = tracker.track(frame_of(picture, i));
    good += seen && norm(seen->centre - path.centres[at]) < kGate;
  }
  return static_cast<double>(good) / (frames - 1);
}

TEST(BlutTracker, HoldsATargetThatJerksAndBlursByUpToThirtyPixels) {
  // benchmarks/blut_competence.cpp has ten worlds and more frames.
  for (const std::uint64_t seed : {2, 5, 8}) {
    const double blut = held(*blut_tracker({}, seed), seed, 36, 40);
    EXPECT_GE(blut, 0.95) << seed;
    EXPECT_GE(blut, held(*l1_tracker(l1_defaults(), seed), seed, 36, 40)) << seed;
    EXPECT_GE(blut, held(*kcf_tracker({}), seed, 36, 40)) << seed;
  }
}

TEST(ParticleTrackers, HoldATargetThatMovesALittleInEveryFrame) {
  EXPECT_EQ(held(*blut_tracker({}, 1), 3, 6, 25), 1);
  EXPECT_EQ(held(*l1_tracker(l1_defaults(), 1), 3, 6, 25), 1);
  EXPECT_EQ(held(*ivt_tracker({}, 1), 3, 6, 25), 1);
}

/// What is said of the second frame, the first being sharp.
std::optional<Sighting> said_of(const BlurEstimate& blur, std::uint64_t seed,
                                const BlutOptions& options = {}) {
  const BlurredWorld world(seed);
  const cv::Mat first = world.picture(BlurredWorld::kMiddle);
  const cv::Mat second = world.picture(BlurredWorld::kMiddle + Vec2{3.3, -2.1}, blur);
  const auto tracker = blut_tracker(options, seed);
  tracker->start(frame_of(first, 0), BlurredWorld::box(BlurredWorld::kMiddle));
  return tracker->track(frame_of(second, 1));
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.at(values.size() / 2);
}

TEST(BlutTracker, TellsTheDirectionAndLengthOfAKnownBlur) {
  std::vector<double> directions_deg, lengths;
  for (const double share : {0.15, 0.2, 0.3, 0.4})
    for (int i = 0; i < 6; ++i) {
      // Between the templates' directions.
      const BlurEstimate truth{.direction_rad = kPi * (i + 0.37) / 6,
                               .length_px = share * BlurredWorld::kWidth};
      const auto seen = said_of(truth, static_cast<std::uint64_t>(i));
      ASSERT_TRUE(seen && seen->blur) << share << ", " << i;
      EXPECT_GE(seen->blur->direction_rad, 0);
      EXPECT_LT(seen->blur->direction_rad, kPi);
      directions_deg.push_back(
          std::abs(std::remainder(seen->blur->direction_rad - truth.direction_rad, kPi)) * 180 / kPi);
      lengths.push_back(std::abs(seen->blur->length_px / truth.length_px - 1));
    }
  EXPECT_LT(median(directions_deg), 5);
  EXPECT_LT(median(lengths), 0.1);
}

TEST(BlutTracker, TellsNoBlurOfASharpTarget) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const auto seen = said_of({}, seed);
    ASSERT_TRUE(seen);
    EXPECT_FALSE(seen->blur) << seed;
  }
}

TEST(BlutTracker, TellsNoBlurWithoutBlurTemplates) {
  const auto seen = said_of({.direction_rad = 1, .length_px = 20}, 1, {.blur_templates = false});
  ASSERT_TRUE(seen);
  EXPECT_FALSE(seen->blur);
}

TEST(BlutTracker, SaysTheSameWithAndWithoutTheBound) {
  const BlurEstimate blur{.direction_rad = 1, .length_px = 20};
  const auto with = said_of(blur, 4, {.bound = true}), without = said_of(blur, 4, {.bound = false});
  ASSERT_TRUE(with && without);
  EXPECT_EQ(with->centre, without->centre);
  EXPECT_EQ(with->blur, without->blur);
}

using Maker = std::function<std::unique_ptr<Tracker>(std::uint64_t seed)>;
const std::vector<std::pair<std::string, Maker>> kAll{
    {"blut", [](std::uint64_t seed) { return blut_tracker({}, seed); }},
    {"l1", [](std::uint64_t seed) { return l1_tracker(l1_defaults(), seed); }},
    {"ivt", [](std::uint64_t seed) { return ivt_tracker({}, seed); }}};

std::vector<std::optional<Sighting>> answers(const Maker& make, std::uint64_t seed) {
  const BlurredWorld world(7);
  const BlurredPath path = blurred_path(12, 20, 7);
  const auto tracker = make(seed);
  std::vector<std::optional<Sighting>> all;
  for (std::size_t i = 0; i < path.centres.size(); ++i) {
    const cv::Mat picture = world.picture(path.centres[i], path.blurs[i]);
    const Frame frame = frame_of(picture, static_cast<FrameIndex>(i));
    if (i == 0)
      tracker->start(frame, BlurredWorld::box(path.centres[0]));
    else
      all.push_back(tracker->track(frame));
  }
  return all;
}

TEST(ParticleTrackers, SayTheSameForTheSameSeedInAnyThreadAndSomethingElseForAnother) {
  for (const auto& [name, make] : kAll) {
    const auto here = answers(make, 1);
    std::vector<std::optional<Sighting>> there, beside;
    std::thread one([&, &maker = make] { there = answers(maker, 1); });
    std::thread two([&, &maker = make] { beside = answers(maker, 1); });
    one.join(), two.join();
    EXPECT_EQ(here, there) << name;
    EXPECT_EQ(here, beside) << name;
    EXPECT_NE(here, answers(make, 2)) << name;
  }
}

TEST(ParticleTrackers, LookWhereTheyAreToldToExpectTheTarget) {
  const BlurredWorld world(3);
  const Vec2 from = BlurredWorld::kMiddle, to = from + Vec2{95, -40};  // more than a width away
  const cv::Mat first = world.picture(from), second = world.picture(to);
  for (const auto& [name, make] : kAll) {
    const auto near = [&](const std::optional<Sighting>& s) { return s && norm(s->centre - to) < kGate; };
    const auto untold = make(1), told = make(1), vaguely = make(1);
    for (const auto* tracker : {&untold, &told, &vaguely})
      (*tracker)->start(frame_of(first, 0), BlurredWorld::box(from));
    told->expect(BlurredWorld::box(to + Vec2{4, 3}), 5);
    vaguely->expect(BlurredWorld::box(to + Vec2{-20, 20}), 20);
    EXPECT_FALSE(near(untold->track(frame_of(second, 1)))) << name;
    EXPECT_TRUE(near(told->track(frame_of(second, 1)))) << name;
    EXPECT_TRUE(near(vaguely->track(frame_of(second, 1)))) << name;
  }
}

TEST(ParticleTrackers, StayWhereTheyWereWhileNothingIsToBeSeen) {
  const BlurredWorld world(3);
  const Vec2 place = BlurredWorld::kMiddle;
  const cv::Mat picture = world.picture(place), black = cv::Mat1b(picture.size(), std::uint8_t{0});
  for (const auto& [name, make] : kAll) {
    const auto tracker = make(1);
    tracker->start(frame_of(picture, 0), BlurredWorld::box(place));
    for (FrameIndex i = 1; i <= 10; ++i) EXPECT_FALSE(tracker->track(frame_of(black, i))) << name;
    const auto seen = tracker->track(frame_of(picture, 11));
    ASSERT_TRUE(seen) << name;
    EXPECT_LT(norm(seen->centre - place), 4) << name;
  }
}

TEST(ParticleTrackers, RefuseAFrameInWhichTimeRunsBackwards) {
  const cv::Mat picture = patch_at({40, 46});
  for (const auto& [name, make] : kAll) {
    const auto tracker = make(1);
    tracker->start(frame_of(picture, 5), patch_box({40, 46}));
    EXPECT_THROW(tracker->track(frame_of(picture, 4)), Error) << name;
    EXPECT_TRUE(tracker->track(frame_of(picture, 6))) << name;  // and go on
    EXPECT_THROW(tracker->track(frame_of(picture, 5)), Error) << name;
  }
}

/// The target's look changes to another one in 30 frames.
double confidence_after_change(const BlutOptions& options) {
  const cv::Mat before = BlurredWorld(1).picture(BlurredWorld::kMiddle);
  const cv::Mat after = BlurredWorld(2).picture(BlurredWorld::kMiddle);
  const auto tracker = blut_tracker(options, 1);
  tracker->start(frame_of(before, 0), BlurredWorld::box(BlurredWorld::kMiddle));
  double confidence = 0;
  for (int i = 1; i <= 30; ++i) {
    cv::Mat mixed;
    cv::addWeighted(before, 1 - i / 30.0, after, i / 30.0, 0, mixed);
    const auto seen = tracker->track(frame_of(mixed, i));
    confidence = seen ? seen->confidence : 0;
  }
  return confidence;
}

TEST(BlutTracker, LearnsALookThatChangesSlowlyUnlessToldNotTo) {
  EXPECT_GT(confidence_after_change({}), 0.8);
  EXPECT_LT(confidence_after_change({.update = false}), 0.6);
}

TEST(BlutTracker, SaysLostBelowTheLeastConfidence) {
  const BlurredWorld world(3), other(4);
  const cv::Mat first = world.picture(BlurredWorld::kMiddle), second = other.picture(BlurredWorld::kMiddle);
  BlutOptions options;
  for (const double least : {0.0, 0.95}) {
    options.particles.least_confidence = least;
    const auto tracker = blut_tracker(options, 1);
    tracker->start(frame_of(first, 0), BlurredWorld::box(BlurredWorld::kMiddle));
    EXPECT_TRUE(tracker->track(frame_of(first, 1)));
    EXPECT_EQ(tracker->track(frame_of(second, 2)).has_value(), least == 0);
  }
}

TEST(Occlusion, IsTheLargestPieceThatNoTemplateExplains) {
  const particles::Grid grid{20, 10};
  Eigen::VectorXf trivial = Eigen::VectorXf::Zero(grid.size());
  EXPECT_EQ(blut::occluded_share(trivial, grid, 0.4), 0);
  const auto cover = [&](int left, int top, int width, int height, float value) {
    for (int y = top; y < top + height; ++y)
      for (int x = left; x < left + width; ++x) trivial[y * grid.columns + x] = value;
  };
  cover(0, 0, 6, 5, 0.1F);     // a standard deviation is 0.071
  cover(12, 0, 8, 10, -0.1F);  // the larger one
  cover(15, 5, 1, 1, 0);       // a hole that is closed
  cover(8, 4, 2, 2, 0.02F);    // small enough to be explained
  EXPECT_NEAR(blut::occluded_share(trivial, grid, 0.4), 80.0 / 200, 1e-9);
}

TEST(ParticleTrackerOptions, WithoutAnyGivenAreTheDefaultsThatAreListed) {
  const auto b = blut_options(Options("blut", blut_option_list(), {}));
  const BlutOptions d;
  EXPECT_EQ(std::tuple(b.particles.particles, b.particles.position_sigma, b.templates, b.template_weight,
                       b.blur_weight, b.fan.directions, b.fan.longest, b.solver.rounds, b.solver.sweeps,
                       b.reading.least_blur, b.reading.length, b.proposal.kappa, b.proposal.velocity,
                       b.proposal.blur_lobes, b.update_angle_deg, b.occlusion_frames, b.bound, b.update),
            std::tuple(d.particles.particles, d.particles.position_sigma, d.templates, d.template_weight,
                       d.blur_weight, d.fan.directions, d.fan.longest, d.solver.rounds, d.solver.sweeps,
                       d.reading.least_blur, d.reading.length, d.proposal.kappa, d.proposal.velocity,
                       d.proposal.blur_lobes, d.update_angle_deg, d.occlusion_frames, d.bound, d.update));
  EXPECT_TRUE(b.blur_templates);
  EXPECT_FALSE(l1_defaults().blur_templates);
  EXPECT_FALSE(l1_defaults().proposal.blur_lobes);
  const auto i = ivt_options(Options("ivt", ivt_option_list(), {}));
  EXPECT_EQ(std::tuple(i.components, i.forgetting, i.batch),
            std::tuple(IvtOptions{}.components, IvtOptions{}.forgetting, IvtOptions{}.batch));
}

TEST(ParticleTrackerOptions, RefuseABlurThatIsShortestAndLongerThanTheLongest) {
  EXPECT_THROW(blut_options(Options("blut", blut_option_list(), {{"shortest_blur", "0.5"}})), Error);
}

}  // namespace
}  // namespace relock
