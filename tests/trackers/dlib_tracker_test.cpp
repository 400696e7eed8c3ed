#include "trackers/dlib_tracker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/error.h"
#include "tests/trackers/moving_patch.h"

namespace relock {
namespace {

constexpr Vec2 kStart{60, 46};

class DlibTracker : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_dlib()) GTEST_SKIP() << "built without dlib";
  }
  static std::unique_ptr<Tracker> started(const DlibOptions& options = {}) {
    auto tracker = dlib_tracker(options);
    const cv::Mat picture = patch_at(kStart);
    tracker->start(frame_of(picture, 0), patch_box(kStart));
    return tracker;
  }
};

TEST_F(DlibTracker, FollowsToAFewPercentOfTheBoxAndNotInWholePixels) {
  const auto tracker = started();
  for (int i = 1; i <= 8; ++i) {
    const Vec2 place = kStart + static_cast<double>(i) * Vec2{0.6, 0.3};
    const cv::Mat picture = patch_at(place);
    const auto sighting = tracker->track(frame_of(picture, i));
    ASSERT_TRUE(sighting);
    // dlib's peak wavers by a pixel of its filter, which is 0.7 px here.
    EXPECT_LT(norm(sighting->centre - centre_of(patch_box(place))), 1.6) << "frame " << i;
    EXPECT_NE(sighting->centre.x * 2, std::round(sighting->centre.x * 2));
    EXPECT_GT(sighting->confidence, 0.5);
    EXPECT_LE(sighting->confidence, 1.0);
  }
}

TEST_F(DlibTracker, SaysAboutTheStartBoxInAPictureThatStandsStill) {
  const auto tracker = dlib_tracker({});
  const cv::Mat picture = patch_at(kStart);
  const Box box{59.7, 45.8, 31.6, 28.4};
  tracker->start(frame_of(picture, 0), box);
  const auto said = tracker->track(frame_of(picture, 1));
  ASSERT_TRUE(said);
  EXPECT_LT(norm(said->centre - centre_of(box)), 0.9);
  EXPECT_GT(intersection_over_union(std::get<Box>(said->outline), box), 0.8);
}

TEST_F(DlibTracker, SaysLostInBlackFramesForAsLongAsTheyLastAndTakesUpAgain) {
  const auto tracker = started();
  const cv::Mat black = cv::Mat3b(120, 160, cv::Vec3b::all(0)), back = patch_at(kStart + Vec2{2, 1});
  FrameIndex i = 0;
  while (++i <= 20) EXPECT_FALSE(tracker->track(frame_of(black, i))) << "frame " << i;
  std::optional<Sighting> seen;
  for (const FrameIndex end = i + 5; !seen && i < end; ++i) seen = tracker->track(frame_of(back, i));
  ASSERT_TRUE(seen);
  EXPECT_GT(intersection_over_union(std::get<Box>(seen->outline), patch_box(kStart + Vec2{2, 1})), 0.5);
}

TEST_F(DlibTracker, OutlivesHundredsOfPicturesOfNothing) {
  const auto tracker = started({.psr_threshold = 0, .filter_size = 5, .num_scale_levels = 2});
  cv::Mat3b noise(120, 160);
  cv::RNG random(3);
  for (FrameIndex i = 1; i <= 200; ++i) {
    random.fill(noise, cv::RNG::UNIFORM, 0, i % 7 == 0 ? 256 : 1);
    EXPECT_NO_THROW(tracker->track(frame_of(noise, i)));
  }
}

TEST_F(DlibTracker, CallsMoreLostWithAHigherThreshold) {
  const cv::Mat next = patch_at(kStart + Vec2{1, 0});
  EXPECT_TRUE(started({.psr_threshold = 0})->track(frame_of(next, 1)));
  EXPECT_FALSE(started({.psr_threshold = 100})->track(frame_of(next, 1)));
}

TEST_F(DlibTracker, RefusesManyThingsInOneProcess) {
  // dlib itself would end the program at the second refusal.
  const cv::Mat picture = patch_at(kStart);
  for (int i = 0; i < 3; ++i) {
    EXPECT_THROW(dlib_tracker({})->start(frame_of(picture, 0), {60, 46, 0, 0}), Error);
    EXPECT_THROW(dlib_tracker({})->track(frame_of(picture, 0)), Error);
  }
}

TEST(DlibTrackerOptions, WithoutAnyGivenAreTheDefaultsThatAreListed) {
  const auto o = dlib_options(Options("dlib", dlib_option_list(), {}));
  const DlibOptions d;
  EXPECT_EQ(std::tuple(o.psr_threshold, o.filter_size, o.num_scale_levels),
            std::tuple(d.psr_threshold, d.filter_size, d.num_scale_levels));
}

}  // namespace
}  // namespace relock
