#include "trackers/flow_tracker.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <thread>

#include "tests/trackers/moving_patch.h"

namespace relock {
namespace {

constexpr Vec2 kStart{60, 46};
const Vec2 kMiddle = centre_of(patch_box(kStart));

/// The small world turned by `degrees` and scaled about the patch's middle.
cv::Mat turned(double degrees, double scale) {
  const auto about = cv::Point2f(static_cast<float>(kMiddle.x), static_cast<float>(kMiddle.y));
  cv::Mat out;
  cv::warpAffine(patch_at(kStart), out, cv::getRotationMatrix2D(about, degrees, scale), {160, 120},
                 cv::INTER_LINEAR, cv::BORDER_REFLECT_101);
  return out;
}

std::unique_ptr<Tracker> started(const FlowOptions& options = {}) {
  auto tracker = flow_tracker(options);
  const cv::Mat picture = patch_at(kStart);
  tracker->start(frame_of(picture, 0), patch_box(kStart));
  return tracker;
}

TEST(FlowTracker, FollowsScaleToAFewPercent) {
  const auto tracker = started();
  std::optional<Sighting> last;
  for (int i = 1; i <= 12; ++i) {
    const cv::Mat picture = turned(0, 1 + 0.04 * i);
    last = tracker->track(frame_of(picture, i));
    ASSERT_TRUE(last) << "frame " << i;
  }
  const Box box = std::get<Box>(last->outline);
  EXPECT_NEAR(box.width, 1.48 * 32, 0.04 * 1.48 * 32);
  EXPECT_NEAR(box.height, 1.48 * 28, 0.04 * 1.48 * 28);
  EXPECT_LT(norm(last->centre - kMiddle), 1);
}

TEST(FlowTracker, StaysOnATurningTargetAndSaysTheUprightBoxUnturned) {
  const auto tracker = started();
  std::optional<Sighting> last;
  for (int i = 1; i <= 18; ++i) {
    const cv::Mat picture = turned(5 * i, 1);
    last = tracker->track(frame_of(picture, i));
    ASSERT_TRUE(last) << "frame " << i;
  }
  const Box box = std::get<Box>(last->outline);
  EXPECT_LT(norm(last->centre - kMiddle), 1.5);
  EXPECT_NEAR(box.width, 32, 2);
  EXPECT_NEAR(box.height, 28, 2);
}

TEST(FlowTracker, FollowsPartsOfAPixel) {
  const auto tracker = started();
  for (int i = 1; i <= 8; ++i) {
    const Vec2 place = kStart + static_cast<double>(i) * Vec2{1.3, -0.4};
    const cv::Mat picture = patch_at(place);
    const auto sighting = tracker->track(frame_of(picture, i));
    ASSERT_TRUE(sighting);
    EXPECT_LT(norm(sighting->centre - centre_of(patch_box(place))), 0.4) << "frame " << i;
  }
}

TEST(FlowTracker, SaysLostWhileThePatchIsGoneAndTakesUpAgainWhereItWas) {
  const auto tracker = started();
  const cv::Mat wall = bare_wall(), back = patch_at(kStart + Vec2{4, 3}),
                black = cv::Mat3b(120, 160, cv::Vec3b::all(0));
  for (FrameIndex i = 1; i <= 10; ++i)
    EXPECT_FALSE(tracker->track(frame_of(i % 2 == 0 ? wall : black, i))) << "frame " << i;
  const auto sighting = tracker->track(frame_of(back, 11));
  ASSERT_TRUE(sighting);
  EXPECT_LT(norm(sighting->centre - centre_of(patch_box(kStart + Vec2{4, 3}))), 0.5);
}

TEST(FlowTracker, StartsItsSearchWhereItIsToldToExpectTheTarget) {
  const Vec2 place = kStart + Vec2{55, -30};
  const cv::Mat picture = patch_at(place);
  const auto near = [&](const std::optional<Sighting>& s) {
    return s && norm(s->centre - centre_of(patch_box(place))) < 0.5;
  };
  const auto untold = started(), told = started();
  EXPECT_FALSE(near(untold->track(frame_of(picture, 1))));
  Box prior = patch_box(place + Vec2{3, -2});
  told->expect(prior, 5);
  EXPECT_TRUE(near(told->track(frame_of(picture, 1))));
  EXPECT_TRUE(near(told->track(frame_of(picture, 2))));  // and needs no hint for the next
}

TEST(FlowTracker, SaysTheSameInAnotherThread) {
  const auto answers = [] {
    std::vector<std::optional<Sighting>> all;
    const auto tracker = started();
    for (int i = 1; i <= 6; ++i) {
      const cv::Mat picture = turned(3 * i, 1 + 0.02 * i);
      all.push_back(tracker->track(frame_of(picture, i)));
    }
    return all;
  };
  const auto here = answers();
  std::vector<std::optional<Sighting>> there, beside;
  std::thread one([&] { there = answers(); }), two([&] { beside = answers(); });
  one.join(), two.join();
  EXPECT_EQ(here, there);
  EXPECT_EQ(here, beside);
}

TEST(FlowTracker, SaysLostWhenMostOfTheBoxHasLeftThePicture) {
  const auto tracker = started({.least_inliers = 3});
  std::optional<Sighting> last = sighting_of(patch_box(kStart));
  for (int i = 1; i <= 30 && last; ++i) {
    const cv::Mat picture = patch_at(kStart + 4.0 * i * Vec2{1, 0});
    last = tracker->track(frame_of(picture, i));
    if (last) {
      EXPECT_GE(share_inside(last->outline, picture_box({160, 120})), 0.25);
    }
  }
  EXPECT_FALSE(last);
}

TEST(FlowTrackerOptions, WithoutAnyGivenAreTheDefaultsThatAreListed) {
  const auto o = flow_options(Options("flow", flow_option_list(), {}));
  const FlowOptions d;
  EXPECT_EQ(std::tuple(o.features, o.window_px, o.levels, o.return_px, o.agreement_px, o.least_inliers),
            std::tuple(d.features, d.window_px, d.levels, d.return_px, d.agreement_px, d.least_inliers));
}

}  // namespace
}  // namespace relock
