#include "trackers/template_tracker.h"

#include <gtest/gtest.h>

#include "tests/trackers/moving_patch.h"

namespace relock {
namespace {

constexpr Vec2 kStart{40, 46};

std::unique_ptr<Tracker> started(const TemplateOptions& options = {}) {
  auto tracker = template_tracker(options);
  const cv::Mat picture = patch_at(kStart);
  tracker->start(frame_of(picture, 0), patch_box(kStart));
  return tracker;
}

TEST(TemplateTracker, ReturnsAtOnceAtTheOtherEndOfThePictureAfterTenFramesWithoutTheTarget) {
  const auto tracker = started({.least_correlation = 0.8});  // some of the wall is alike by 0.5
  const cv::Mat wall = bare_wall(), back = patch_at({110, 8});
  for (FrameIndex i = 1; i <= 10; ++i) EXPECT_FALSE(tracker->track(frame_of(wall, i))) << "frame " << i;
  const auto sighting = tracker->track(frame_of(back, 11));
  ASSERT_TRUE(sighting);
  EXPECT_LT(norm(sighting->centre - centre_of(patch_box({110, 8}))), 0.1);
  EXPECT_GT(sighting->confidence, 0.95);
}

TEST(TemplateTracker, FindsThePlaceToAPartOfAPixel) {
  for (const int shrink : {1, 2, 3}) {
    const auto tracker = started({.shrink = shrink});
    for (const Vec2 place : {Vec2{40, 46}, Vec2{71.5, 30.25}, Vec2{12.3, 80.8}}) {
      const cv::Mat picture = patch_at(place);
      const auto sighting = tracker->track(frame_of(picture, 1));
      ASSERT_TRUE(sighting);
      EXPECT_LT(norm(sighting->centre - centre_of(patch_box(place))), 0.15) << shrink;
    }
  }
}

TEST(TemplateTracker, KeepsTheStartBoxsPartsOfAPixel) {
  const auto tracker = template_tracker({});
  const cv::Mat picture = patch_at(kStart);
  const Box box{39.7, 45.8, 31.6, 28.4};
  tracker->start(frame_of(picture, 0), box);
  const auto said = std::get<Box>(tracker->track(frame_of(picture, 1)).value().outline);
  EXPECT_NEAR(said.x, box.x, 1e-3);
  EXPECT_NEAR(said.y, box.y, 1e-3);
  EXPECT_NEAR(said.width, box.width, 1e-3);
}

TEST(TemplateTracker, SaysNothingWhereNothingIsAlikeEnough) {
  const auto strict = started({.least_correlation = 0.9}), lax = started({.least_correlation = 0});
  const cv::Mat wall = bare_wall();
  EXPECT_FALSE(strict->track(frame_of(wall, 1)));
  EXPECT_TRUE(lax->track(frame_of(wall, 1)));
}

TEST(TemplateTracker, FindsNothingInFlatPicturesAndAFlatPatchNowhere) {
  const cv::Mat picture = patch_at(kStart);
  for (const int grey : {0, 90, 255}) {
    const cv::Mat flat = cv::Mat3b(120, 160, cv::Vec3b::all(static_cast<std::uint8_t>(grey)));
    EXPECT_FALSE(started({.least_correlation = 0})->track(frame_of(flat, 1)));
    const auto tracker = template_tracker({.least_correlation = 0});
    tracker->start(frame_of(flat, 0), patch_box(kStart));
    EXPECT_FALSE(tracker->track(frame_of(picture, 1)));
  }
}

TEST(TemplateTrackerOptions, WithoutAnyGivenAreTheDefaultsThatAreListed) {
  const auto o = template_options(Options("template", template_option_list(), {}));
  EXPECT_EQ(std::tuple(o.least_correlation, o.shrink),
            std::tuple(TemplateOptions{}.least_correlation, TemplateOptions{}.shrink));
}

}  // namespace
}  // namespace relock
