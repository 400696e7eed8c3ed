// OpenCV's trackers behind the adapter: everything that makes the bare library throw, hang or crash.
#include "trackers/opencv_tracker.h"

#include <gtest/gtest.h>

#include <functional>
#include <ostream>

#include "core/error.h"
#include "tests/trackers/moving_patch.h"

namespace relock {
namespace {

constexpr Vec2 kStart{40, 46};

struct Kind {
  const char* name;
  std::function<std::unique_ptr<Tracker>()> make;
  double least_overlap;  ///< with the patch, while it follows it
};
void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }

std::vector<Kind> kinds() {
  // MIL draws at random; in pictures as small as these it is taken in by the wall when it looks 25 px far.
  std::vector<Kind> all{{"mil", [] { return mil_tracker({.search_radius_px = 8}); }, 0.3}};
  if (has_contributed_trackers()) {
    all.push_back({"kcf", [] { return kcf_tracker({}); }, 0.6});
    all.push_back({"csrt", [] { return csrt_tracker({.number_of_scales = 9}); }, 0.6});
  }
  return all;
}

class OpencvTracker : public testing::TestWithParam<Kind> {
 protected:
  std::unique_ptr<Tracker> tracker = GetParam().make();
  const cv::Mat picture = patch_at(kStart);

  void start() { tracker->start(frame_of(picture, 0), patch_box(kStart)); }
  std::string refusal(const Box& box) {
    try {
      GetParam().make()->start(frame_of(picture, 0), box);
    } catch (const Error& fault) {
      return fault.what();
    }
    return "";
  }
};

bool mentions(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_P(OpencvTracker, FollowsAPatchThatMovesThreePixelsAFrame) {
  start();
  for (int i = 1; i <= 8; ++i) {
    const Vec2 place = kStart + 3.0 * i * Vec2{1, 0};
    const cv::Mat next = patch_at(place);
    const auto sighting = tracker->track(frame_of(next, i));
    ASSERT_TRUE(sighting) << "frame " << i;
    EXPECT_GT(intersection_over_union(std::get<Box>(sighting->outline), patch_box(place)),
              GetParam().least_overlap)
        << "frame " << i;
  }
}

TEST_P(OpencvTracker, RefusesABoxThatIsMostlyOutsideAndSaysSo) {
  for (const Box box : {Box{200, 46, 32, 28}, Box{-60, 46, 32, 28}, Box{-20, 46, 32, 28},
                        Box{40, 110, 32, 28}, Box{-1e9, -1e9, 32, 28}})
    EXPECT_TRUE(mentions(refusal(box), "at least half")) << refusal(box);
  EXPECT_TRUE(mentions(refusal({200, 46, 32, 28}), "x 200, y 46, 32 x 28 px")) << refusal({200, 46, 32, 28});
  EXPECT_TRUE(mentions(refusal({200, 46, 32, 28}), "160 x 120 px"));
}

TEST_P(OpencvTracker, RefusesABoxThatIsTooSmall) {
  for (const Box box : {Box{40, 46, 1, 1}, Box{40, 46, 4, 4}, Box{40, 46, 9.4, 30}, Box{40, 46, 30, 3},
                        Box{-7.5, 46, 16, 28}})  // the last is 9 px wide in the picture
    EXPECT_TRUE(mentions(refusal(box), "10 x 10")) << refusal(box);
}

TEST_P(OpencvTracker, RefusesTheWholePictureAndMore) {
  EXPECT_TRUE(mentions(refusal({-0.5, -0.5, 160, 120}), "whole picture"));
  EXPECT_TRUE(mentions(refusal({-10, -10, 180, 140}), "whole picture"));
  EXPECT_FALSE(refusal({-1e3, -1e3, 3e3, 3e3}).empty());
}

TEST_P(OpencvTracker, TakesABoxThatIsPartlyOutside) {
  const cv::Mat at_edge = patch_at({-6, -5});
  tracker->start(frame_of(at_edge, 0), patch_box({-6, -5}));
  EXPECT_NO_THROW(tracker->track(frame_of(at_edge, 1)));
}

TEST_P(OpencvTracker, TakesABoxOfTenPixelsAndOneThatIsNearlyEverything) {
  for (const Box box : {Box{40, 46, 10, 10}, Box{0.5, 0.5, 158, 118}, Box{39.7, 45.8, 31.6, 28.4}}) {
    const auto fresh = GetParam().make();
    try {
      fresh->start(frame_of(picture, 0), box);
      fresh->track(frame_of(picture, 1));
    } catch (const Error&) {
      // A sentence is as good as an answer; anything else is not.
    }
  }
}

TEST_P(OpencvTracker, RefusesEmptyPictures) {
  EXPECT_THROW(tracker->start(Frame{}, patch_box(kStart)), Error);
  start();
  EXPECT_THROW(tracker->track(Frame{}), Error);
  EXPECT_NO_THROW(tracker->track(frame_of(picture, 2)));  // and goes on with the next
}

TEST_P(OpencvTracker, RefusesPicturesOfAnotherSize) {
  start();
  for (const cv::Size size : {cv::Size{80, 60}, cv::Size{320, 240}, cv::Size{160, 121}, cv::Size{1, 1}})
    EXPECT_THROW(tracker->track(frame_of(cv::Mat3b(size, cv::Vec3b::all(9)), 1)), Error);
  EXPECT_TRUE(tracker->track(frame_of(picture, 2)));
}

TEST_P(OpencvTracker, MayBeStartedOnABetterBoxAfterARefusal) {
  EXPECT_THROW(tracker->start(frame_of(picture, 0), {500, 500, 32, 28}), Error);
  EXPECT_THROW(tracker->track(frame_of(picture, 1)), Error);
  start();
  EXPECT_TRUE(tracker->track(frame_of(picture, 1)));
}

TEST_P(OpencvTracker, TakesAPictureWhoseRowsAreFarApart) {
  cv::Mat3b wide(120, 200, cv::Vec3b::all(7));
  picture.copyTo(wide.colRange(20, 180));
  const cv::Mat part = wide.colRange(20, 180);
  tracker->start(frame_of(part, 0), patch_box(kStart));
  const auto sighting = tracker->track(frame_of(part, 1));
  ASSERT_TRUE(sighting);
  EXPECT_GT(intersection_over_union(std::get<Box>(sighting->outline), patch_box(kStart)),
            GetParam().least_overlap);
}

INSTANTIATE_TEST_SUITE_P(Trackers, OpencvTracker, testing::ValuesIn(kinds()),
                         [](const auto& instance) { return instance.param.name; });

template <class Listed, class Read, class Defaults>
void expect_same_defaults(const Listed& listed, const Read& read, Defaults values) {
  EXPECT_EQ(values(read(Options("it", listed(), {}))), values({}));
}

TEST(OpencvTrackerOptions, WithoutAnyGivenAreTheDefaultsThatAreListed) {
  expect_same_defaults(kcf_option_list, kcf_options, [](const KcfOptions& o) {
    return std::tuple(o.detect_thresh, o.interp_factor, o.resize, o.max_patch_size);
  });
  expect_same_defaults(csrt_option_list, csrt_options, [](const CsrtOptions& o) {
    return std::tuple(o.psr_threshold, o.template_size_px, o.padding, o.filter_lr, o.number_of_scales,
                      o.use_segmentation);
  });
  expect_same_defaults(mil_option_list, mil_options,
                       [](const MilOptions& o) { return std::tuple(o.search_radius_px, o.features); });
}

TEST(OpencvTrackerOptions, ChangeWhatTheTrackerDoes) {
  if (!has_contributed_trackers()) GTEST_SKIP();
  const cv::Mat picture = patch_at(kStart), wall = bare_wall();
  const auto loses = [&](double threshold) {
    const auto tracker = kcf_tracker({.detect_thresh = threshold});
    tracker->start(frame_of(picture, 0), patch_box(kStart));
    tracker->track(frame_of(picture, 1));  // KCF looks for nothing in the first frame after its start
    return !tracker->track(frame_of(wall, 2));
  };
  EXPECT_TRUE(loses(1.0));
  EXPECT_FALSE(loses(0.0));
}

}  // namespace
}  // namespace relock
