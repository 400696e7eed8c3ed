#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/motion_memory.h"
#include "core/random.h"
#include "tests/core/scripted.h"

namespace relock {
namespace {

/// Finds one box, which looks as much alike as it is told.
class ScriptedSearcher final : public Searcher {
 public:
  ScriptedSearcher(double x, double there, double here) : x_(x), there_(there), here_(here) {}
  void remember(const Image&, const Box&) override {}
  std::optional<Found> find(const Image&, const Box&) override {
    return searches_++ == 0 ? Found{box_at(x_), there_} : Found{box_at(0), here_};
  }

 private:
  double x_, there_, here_;
  int searches_ = 0;
};

/// Constant image velocity, 6 px a period to the right, blurred for `share` of the period.
ScriptedTracker::Script steady(double share) {
  return [=](FrameIndex i, const Box&) {
    Sighting sighting = seen_at(50 + 6.0 * static_cast<double>(i));
    if (share > 0) sighting.blur = BlurEstimate{0, 6 * share};
    return sighting;
  };
}

Frame wide_frame(FrameIndex index) {
  static const std::vector<std::uint8_t> pixels(1000 * 100);
  return {index, Time{index * kPeriod}, Image(pixels.data(), {1000, 100}, PixelFormat::gray8, 1000)};
}

TEST(GapAware, TellsNothingAndAnswersAsItsTrackerWhereNoFrameIsMissing) {
  for (const Hints hints : {Hints::honoured, Hints::ignored}) {
    Random random(3);
    const auto log = std::make_shared<ScriptedTracker::Log>();
    const auto script = steady(0.5);
    const auto tracker =
        gap_aware(scripted(script, log), hints, std::make_unique<ScriptedSearcher>(500, 1, 0));
    tracker->start(wide_frame(0), box_at(50));
    for (FrameIndex i = 1; i < 100; ++i) {
      Frame frame = wide_frame(i);
      frame.captured += Duration(static_cast<std::int64_t>(random.below(8'000'000)));  // jitter is no gap
      EXPECT_EQ(tracker->track(frame), script(i, {}));
    }
    EXPECT_TRUE(log->expected.empty());
    EXPECT_EQ(log->starts.size(), 1u);
  }
}

TEST(GapAware, ExpectsTheTargetWhereConstantVelocityTookItAndIsLessSureAfterALongerGap) {
  double sigma = 0;
  for (const FrameIndex missing : {1, 3, 8}) {
    const auto log = std::make_shared<ScriptedTracker::Log>();
    const auto tracker = gap_aware(scripted(steady(0), log), Hints::honoured, nullptr);
    tracker->start(wide_frame(0), box_at(50));
    for (FrameIndex i = 1; i <= 20; ++i) tracker->track(wide_frame(i));
    tracker->track(wide_frame(21 + missing));
    ASSERT_EQ(log->expected.size(), 1u);
    EXPECT_NEAR(centre_of(log->expected[0].first).x, 50 + 6.0 * static_cast<double>(21 + missing), 1e-5);
    EXPECT_GT(log->expected[0].second, sigma);
    sigma = log->expected[0].second;
  }
}

TEST(GapAware, StartsItsTrackerAnewOnlyWhereTheTargetIsPlainlyMoreAlike) {
  for (const bool plainly : {true, false}) {
    const auto log = std::make_shared<ScriptedTracker::Log>();
    const auto tracker = gap_aware(scripted(steady(0), log), Hints::ignored,
                                   std::make_unique<ScriptedSearcher>(230, plainly ? 0.9 : 0.65, 0.6));
    tracker->start(wide_frame(0), box_at(50));
    for (FrameIndex i = 1; i <= 20; ++i) tracker->track(wide_frame(i));
    const auto said = tracker->track(wide_frame(28));
    EXPECT_EQ(log->starts.size(), plainly ? 2u : 1u);
    EXPECT_EQ(said->centre.x, plainly ? 230 : 50 + 6 * 28);
  }
}

TEST(BlurPredict, IsExactForConstantImageVelocityWhateverTheExposureItLearns) {
  for (const double share : {0.35, 0.5, 0.85, 1.0}) {
    const auto log = std::make_shared<ScriptedTracker::Log>();
    const auto tracker = blur_predict(scripted(steady(share), log), Hints::honoured, nullptr, {});
    tracker->start(wide_frame(0), box_at(50));
    for (FrameIndex i = 1; i <= 20; ++i) tracker->track(wide_frame(i));
    tracker->track(wide_frame(27));
    ASSERT_EQ(log->expected.size(), 1u);
    EXPECT_NEAR(centre_of(log->expected[0].first).x, 50 + 6 * 27, 1e-4) << share;
  }
}

TEST(BlurPredict, KnowsASpeedThatChangedInTheLastFrameWhichPositionsDoNotTell) {
  const auto script = [](FrameIndex i, const Box&) {
    Sighting sighting = seen_at(400 - 6.0 * static_cast<double>(i));
    sighting.blur = BlurEstimate{0, i == 20 ? 10.0 : 3.0};  // at last it went 20 px a period
    return sighting;
  };
  const auto log = std::make_shared<ScriptedTracker::Log>();
  const auto tracker = blur_predict(scripted(script, log), Hints::honoured, nullptr, {});
  tracker->start(wide_frame(0), box_at(400));
  for (FrameIndex i = 1; i <= 20; ++i) tracker->track(wide_frame(i));
  tracker->track(wide_frame(25));
  EXPECT_NEAR(centre_of(log->expected.at(0).first).x, 400 - 6 * 20 - 5 * 20, 1e-4);
}

TEST(BlurPredict, TakesTheBlurFromAMeterWhereTheTrackerHasNone) {
  const auto log = std::make_shared<ScriptedTracker::Log>();
  const auto detector = std::make_shared<ScriptedDetector>([n = 0]() mutable {
    Sighting near = seen_at(50 + 6.0 * ++n), far = seen_at(800);
    near.blur = BlurEstimate{0, n == 11 ? 10.0 : 3.0};  // at last it went 20 px a period
    far.blur = BlurEstimate{1, 50};
    return Sightings{far, near};
  });
  GapOptions options;
  options.exposure_s = 0.5 * seconds(kPeriod);
  const auto tracker =
      blur_predict(scripted(steady(0), log), Hints::honoured, nullptr, blur_of_detections(detector), options);
  tracker->start(wide_frame(0), box_at(50));
  for (FrameIndex i = 1; i <= 10; ++i) tracker->track(wide_frame(i));
  tracker->track(wide_frame(14));
  // The meter is asked at the start, too, so that the n-th look is at frame n - 1, 6 px off: within half a size.
  EXPECT_NEAR(centre_of(log->expected.at(0).first).x, 50 + 6 * 10 + 4 * 20, 1e-4);
}

TEST(BlurPredict, GoesByTheAnswersWhereTheBlurHasToldWorse) {
  Random random(7);
  const auto script = [&](FrameIndex i, const Box&) {
    Sighting sighting = seen_at(50 + 6.0 * static_cast<double>(i));
    sighting.blur = BlurEstimate{std::numbers::pi * random.uniform(), 4 + 8 * random.uniform()};
    return sighting;
  };
  const auto log = std::make_shared<ScriptedTracker::Log>();
  const auto tracker = blur_predict(scripted(script, log), Hints::honoured, nullptr, {});
  tracker->start(wide_frame(0), box_at(50));
  for (FrameIndex i = 1; i <= 20; ++i) tracker->track(wide_frame(i));
  tracker->track(wide_frame(27));
  EXPECT_NEAR(centre_of(log->expected.at(0).first).x, 50 + 6 * 27, 1e-4);
}

/// A blur of 5 px to the right or left, half a period long, in every picture.
std::optional<BlurEstimate> always_blurred(const Image&, const Box&) { return BlurEstimate{0, 5}; }

GapOptions known_rate_and_exposure() {
  GapOptions options;
  options.period_s = seconds(kPeriod);
  options.exposure_s = 0.5 * seconds(kPeriod);
  return options;
}

/// Finds the target in one of the regions it is shown, the n-th.
class OneSidedSearcher final : public Searcher {
 public:
  OneSidedSearcher(std::size_t nth, std::vector<Box>& regions) : nth_(nth), regions_(regions) {}
  void remember(const Image&, const Box&) override {}
  std::optional<Found> find(const Image&, const Box& region) override {
    regions_.push_back(region);
    return Found{region, regions_.size() == nth_ ? 0.9 : 0.2};
  }

 private:
  std::size_t nth_;
  std::vector<Box>& regions_;
};

TEST(BlurPredict, LooksOnBothSidesWhenTheGapFollowsTheStartAtOnce) {
  for (const std::size_t side : {1u, 2u}) {
    std::vector<Box> regions;
    const auto log = std::make_shared<ScriptedTracker::Log>();
    const auto tracker = blur_predict(scripted(steady(0), log), Hints::ignored,
                                      std::make_unique<OneSidedSearcher>(side, regions), always_blurred,
                                      known_rate_and_exposure());
    tracker->start(wide_frame(0), box_at(500));
    const auto said = tracker->track(wide_frame(4));
    EXPECT_NEAR(centre_of(regions.at(0)).x, 500 + 4 * 10, 1e-4);
    EXPECT_NEAR(centre_of(regions.at(1)).x, 500 - 4 * 10, 1e-4);
    EXPECT_EQ(said->centre.x, centre_of(regions.at(side - 1)).x);
    EXPECT_EQ(log->starts.size(), 2u);
  }
}

TEST(BlurPredict, IsAsUncertainAsBothSidesAreFarWhereItsTrackerTakesOnePlace) {
  const auto log = std::make_shared<ScriptedTracker::Log>();
  const auto tracker = blur_predict(scripted(steady(0), log), Hints::honoured, nullptr, always_blurred,
                                    known_rate_and_exposure());
  tracker->start(wide_frame(0), box_at(500));
  tracker->track(wide_frame(4));
  EXPECT_EQ(centre_of(log->expected.at(0).first).x, 500);
  EXPECT_GE(log->expected.at(0).second, 4 * 10);
}

TEST(BlurPredict, TakesNoWayFromATrackerThatStandsStillInItsFirstFrame) {
  std::vector<Box> regions;
  const auto log = std::make_shared<ScriptedTracker::Log>();
  const auto still = [](FrameIndex, const Box&) { return seen_at(500.5); };
  const auto tracker =
      blur_predict(scripted(still, log), Hints::ignored, std::make_unique<OneSidedSearcher>(2, regions),
                   always_blurred, known_rate_and_exposure());
  tracker->start(wide_frame(0), box_at(500));
  tracker->track(wide_frame(1));
  tracker->track(wide_frame(5));
  EXPECT_LT(centre_of(regions.at(1)).x, 500);
}

TEST(GapAware, KnowsGapsForGapsFromTheStartWhereTheRateIsGiven) {
  for (const bool given : {true, false}) {
    GapOptions options;
    if (given) options.period_s = seconds(kPeriod);
    const auto log = std::make_shared<ScriptedTracker::Log>();
    const auto tracker = gap_aware(scripted(steady(0), log), Hints::honoured, nullptr, options);
    tracker->start(wide_frame(0), box_at(50));
    tracker->track(wide_frame(5));  // a period, as far as anybody knows who is not told
    tracker->track(wide_frame(10));
    ASSERT_EQ(log->expected.size(), given ? 2u : 0u);
    if (!given) continue;
    EXPECT_EQ(centre_of(log->expected[0].first).x, 50);  // no velocity is known yet: about the old place
    EXPECT_NEAR(centre_of(log->expected[1].first).x, 50 + 6 * 10, 6 + 1e-4);
  }
}

TEST(MotionMemory, LearnsKappaRobustlyAgainstAThirdOfWildBlurs) {
  Random random(5);
  MotionMemory memory;
  for (FrameIndex i = 0; i < 60; ++i) {
    const double x = 9.0 * static_cast<double>(i);
    memory.show(Time{i * kPeriod});
    memory.see(box_at(x), BlurEstimate{0, random.chance(0.33) ? 2 + 40 * random.uniform() : 6.0});
  }
  EXPECT_NEAR(memory.learned_kappa().value(), 1.5, 0.1);
}

}  // namespace
}  // namespace relock
