#include "trackers/legacy_tracker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "core/error.h"
#include "tests/trackers/moving_patch.h"

namespace relock {
namespace {

constexpr Vec2 kStart{40, 46};
constexpr BoostingOptions kQuickBoosting{.classifiers = 20, .first_iterations = 5};

class LegacyTracker : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_legacy_trackers()) GTEST_SKIP() << "built without OpenCV's contributed modules";
  }
  const cv::Mat picture = patch_at(kStart);
};

std::optional<Box> box_in(Tracker& tracker, const cv::Mat& pixels, FrameIndex index) {
  const auto sighting = tracker.track(frame_of(pixels, index));
  return sighting ? std::optional(std::get<Box>(sighting->outline)) : std::nullopt;
}

TEST_F(LegacyTracker, FollowsAPatchThatMovesThreePixelsAFrame) {
  for (auto make : {+[] { return mosse_tracker(); }, +[] { return medianflow_tracker({}); },
                    +[] { return boosting_tracker(kQuickBoosting); }}) {
    const auto tracker = make();
    tracker->start(frame_of(picture, 0), patch_box(kStart));
    for (int i = 1; i <= 6; ++i) {
      const Vec2 place = kStart + 3.0 * i * Vec2{1, 0};
      const auto box = box_in(*tracker, patch_at(place), i);
      ASSERT_TRUE(box) << "frame " << i;
      EXPECT_GT(intersection_over_union(*box, patch_box(place)), 0.6) << "frame " << i;
    }
  }
}

TEST_F(LegacyTracker, MedianFlowKeepsTheStartBoxsPartsOfAPixelInAPictureThatStandsStill) {
  const Box box{39.7, 45.8, 31.6, 28.4};
  const auto tracker = medianflow_tracker({});
  tracker->start(frame_of(picture, 0), box);
  const auto said = box_in(*tracker, picture, 1);
  ASSERT_TRUE(said);
  EXPECT_NEAR(said->x, box.x, 0.01);
  EXPECT_NEAR(said->y, box.y, 0.01);
  EXPECT_NEAR(said->width, box.width, 0.01);
}

TEST_F(LegacyTracker, MosseSaysABoxAroundTheStartBoxOfASizeItCanTransform) {
  const auto tracker = mosse_tracker();
  tracker->start(frame_of(picture, 0), patch_box(kStart));
  const auto said = box_in(*tracker, picture, 1);
  ASSERT_TRUE(said);
  EXPECT_EQ(said->width, 32);
  EXPECT_EQ(said->height, 30);  // not 28, which has a factor of 7
  EXPECT_LT(norm(centre_of(*said) - centre_of(patch_box(kStart))), 0.6);
}

TEST_F(LegacyTracker, MedianFlowFollowsHalfAPixel) {
  const auto tracker = medianflow_tracker({});
  tracker->start(frame_of(picture, 0), patch_box(kStart));
  const Vec2 place = kStart + Vec2{1.5, 0.5};
  const auto box = box_in(*tracker, patch_at(place), 1);
  ASSERT_TRUE(box);
  EXPECT_LT(norm(centre_of(*box) - centre_of(patch_box(place))), 0.25);
}

TEST_F(LegacyTracker, BoostingTakesABoxOfPartsOfAPixelAndSaysWholeOnes) {
  const auto tracker = boosting_tracker(kQuickBoosting);
  tracker->start(frame_of(picture, 0), {39.7, 45.8, 31.6, 28.4});
  const auto box = box_in(*tracker, picture, 1);
  ASSERT_TRUE(box);
  EXPECT_EQ(box->width, 32);
  EXPECT_EQ(box->height, 28);
  EXPECT_EQ(box->x + 0.5, std::round(box->x + 0.5));
}

TEST_F(LegacyTracker, BoostingLeavesTheProgramsRandAlone) {
  std::srand(5);
  const int first = std::rand(), second = std::rand();
  std::srand(5);
  EXPECT_EQ(std::rand(), first);
  const auto tracker = boosting_tracker(kQuickBoosting);
  tracker->start(frame_of(picture, 0), patch_box(kStart));
  tracker->track(frame_of(picture, 1));
#ifdef __GLIBC__
  EXPECT_EQ(std::rand(), second);
#else
  (void)second;
#endif
}

TEST_F(LegacyTracker, TldSaysNoBoxOutsideThePictureHoweverSmallItsStart) {
  const auto tracker = tld_tracker();
  tracker->start(frame_of(picture, 0), {40, 46, 10, 10});
  for (FrameIndex i = 1; i <= 5; ++i)
    if (const auto box = box_in(*tracker, i % 2 == 0 ? picture : cv::Mat(bare_wall()), i)) {
      EXPECT_GT(share_inside(*box, picture_box({160, 120})), 0);
    }
}

TEST(LegacyTrackerOptions, WithoutAnyGivenAreTheDefaultsThatAreListed) {
  const auto m = medianflow_options(Options("medianflow", medianflow_option_list(), {}));
  const MedianFlowOptions d;
  EXPECT_EQ(std::tuple(m.points_in_grid, m.window_px, m.levels, m.max_disagreement),
            std::tuple(d.points_in_grid, d.window_px, d.levels, d.max_disagreement));
  const auto b = boosting_options(Options("boosting", boosting_option_list(), {}));
  const BoostingOptions e;
  EXPECT_EQ(std::tuple(b.classifiers, b.search_factor, b.first_iterations),
            std::tuple(e.classifiers, e.search_factor, e.first_iterations));
}

}  // namespace
}  // namespace relock
