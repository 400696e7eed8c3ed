#include "trackers/yardsticks.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "core/error.h"
#include "tests/trackers/moving_patch.h"

namespace relock {
namespace {

constexpr Vec2 kStart{30, 40};

Vec2 centre(const std::optional<Sighting>& sighting) { return sighting.value().centre; }

TEST(StillTracker, SaysTheStartBoxForEver) {
  const auto tracker = still_tracker();
  const cv::Mat first = patch_at(kStart), later = patch_at({90, 60});
  const Box box{29.25, 39.5, 31.5, 27};
  tracker->start(frame_of(first, 0), box);
  for (FrameIndex i = 1; i < 4; ++i) EXPECT_EQ(tracker->track(frame_of(later, i)), sighting_of(box));
}

/// Centre that `linear` says at `at` after it was shown the patch moving at `velocity` (px a frame) on
/// `seen`.
std::optional<Sighting> linear_after(Vec2 velocity, const std::vector<int>& seen, int at, int frames = 5) {
  const auto tracker = linear_tracker({.frames = frames});
  const cv::Mat first = patch_at(kStart), wall = bare_wall();
  tracker->start(frame_of(first, 0), patch_box(kStart));
  for (const int i : seen) {
    const cv::Mat picture = patch_at(kStart + static_cast<double>(i) * velocity);
    tracker->track(frame_of(picture, i));
  }
  return tracker->track(frame_of(wall, at));
}

Vec2 truth(Vec2 velocity, int at) {
  return centre_of(patch_box(kStart + static_cast<double>(at) * velocity));
}

TEST(LinearTracker, GoesOnAtTheVelocityOfTheFirstFramesToAPartOfAPixel) {
  for (const Vec2 velocity : {Vec2{3, 0}, Vec2{1.3, 0.7}, Vec2{-0.4, 0.9}, Vec2{0, 0}})
    EXPECT_LT(norm(centre(linear_after(velocity, {1, 2, 3, 4, 5}, 20)) - truth(velocity, 20)), 0.5);
}

TEST(LinearTracker, CountsTimeAndNotFramesWhenSomeAreMissing) {
  const Vec2 velocity{1.5, 0.5};
  EXPECT_LT(norm(centre(linear_after(velocity, {1, 4, 5, 9, 10}, 25)) - truth(velocity, 25)), 0.5);
}

TEST(LinearTracker, StaysWhereItIsWhenItMayLookAtNoFrame) {
  EXPECT_EQ(centre(linear_after({3, 0}, {1, 2, 3}, 9, 0)), centre_of(patch_box(kStart)));
}

TEST(LinearTracker, DoesNotLookAtFramesAfterTheFirst) {
  const auto tracker = linear_tracker({.frames = 2});
  const cv::Mat first = patch_at(kStart);
  tracker->start(frame_of(first, 0), patch_box(kStart));
  for (int i = 1; i <= 6; ++i) {
    // To the right for two frames, then back.
    const cv::Mat picture = patch_at(kStart + Vec2{2.0 * std::min(i, 4 - i), 0});
    const auto sighting = tracker->track(frame_of(picture, i));
    if (i > 2) {
      EXPECT_NEAR(centre(sighting).x, truth({2, 0}, i).x, 0.5);
    }
  }
}

TEST(LinearTracker, SaysNothingOnceTheBoxHasLeftThePicture) {
  EXPECT_TRUE(linear_after({3, 0}, {1, 2, 3, 4, 5}, 40));
  EXPECT_FALSE(linear_after({3, 0}, {1, 2, 3, 4, 5}, 50));
}

TEST(LinearTracker, StandsStillWhenThePatchIsNowhereToBeFound) {
  const auto tracker = linear_tracker({});
  const cv::Mat first = patch_at(kStart), black = cv::Mat3b(120, 160, cv::Vec3b::all(0));
  tracker->start(frame_of(first, 0), patch_box(kStart));
  for (int i = 1; i < 8; ++i)
    EXPECT_EQ(centre(tracker->track(frame_of(black, i))), centre_of(patch_box(kStart)));
}

TEST(LinearTracker, ThrowsForNoOddPictureAndNoOddTime) {
  const cv::Mat first = patch_at(kStart);
  cv::Mat gray;
  cv::cvtColor(first, gray, cv::COLOR_BGR2GRAY);
  const cv::Mat odd[] = {cv::Mat3b(4, 4, cv::Vec3b::all(3)), cv::Mat3b(500, 30, cv::Vec3b::all(3)), gray,
                         cv::Mat1b(1, 1, std::uint8_t{0})};
  for (const Box box : {patch_box(kStart), Box{0, 0, 1, 1}, Box{-50, -50, 1e6, 1e6}}) {
    const auto tracker = linear_tracker({.frames = 100});
    tracker->start(frame_of(first, 5), box);
    for (const cv::Mat& picture : odd)
      for (const FrameIndex index : {5, 4, 6, 1'000'000})
        EXPECT_NO_THROW(tracker->track(frame_of(picture, index)));
  }
}

TEST(Yardsticks, RefuseAnEmptyPictureAndABoxOutsideOfIt) {
  const cv::Mat first = patch_at(kStart);
  for (const bool is_still : {true, false}) {
    const auto make = [&] { return is_still ? still_tracker() : linear_tracker({}); };
    EXPECT_THROW(make()->start(Frame{}, patch_box(kStart)), Error);
    EXPECT_THROW(make()->start(frame_of(first, 0), {-1e6, 3, 10, 10}), Error);
    const auto tracker = make();
    tracker->start(frame_of(first, 0), patch_box(kStart));
    EXPECT_THROW(tracker->track(Frame{}), Error);
  }
}

}  // namespace
}  // namespace relock
