// What holds for every tracker that comes with relock.
#include <gtest/gtest.h>

#include <limits>
#include <opencv2/imgproc.hpp>
#include <ostream>

#include "core/error.h"
#include "tests/trackers/moving_patch.h"
#include "trackers/builtin.h"

namespace relock {

void PrintTo(const TrackerEntry& entry, std::ostream* out) { *out << entry.name; }

namespace {

const Registry<TrackerEntry>& registry() {
  static const auto all = [] {
    Registry<TrackerEntry> filled;
    add_builtin_trackers(filled);
    return filled;
  }();
  return all;
}

/// Those that can be tried here; a network without its files, or what a library lacks, cannot.
std::vector<TrackerEntry> ready() {
  std::vector<TrackerEntry> all;
  for (const TrackerEntry& entry : registry().entries())
    if (entry.needs.empty()) all.push_back(entry);
  return all;
}

class EveryTracker : public testing::TestWithParam<TrackerEntry> {
 protected:
  static std::unique_ptr<Tracker> make() {
    const TrackerEntry& entry = GetParam();
    auto given = std::map<std::string, std::string>{};
    if (entry.name == "csrt") given["number_of_scales"] = "9";  // faster
    if (entry.name == "boosting") given = {{"first_iterations", "5"}, {"classifiers", "20"}};
    return entry.make(Options(entry.name, entry.options, given), 1);
  }
  static std::unique_ptr<Tracker> started(const cv::Mat& pixels) {
    auto tracker = make();
    tracker->start(frame_of(pixels, 0), patch_box(kStart));
    return tracker;
  }
  static constexpr Vec2 kStart{40, 46};
};

Vec2 after(Vec2 start, int frames) { return start + static_cast<double>(frames) * Vec2{3, 1}; }

TEST_P(EveryTracker, LeavesThePictureAsItWas) {
  for (const bool gray : {false, true}) {
    cv::Mat first = patch_at(kStart), second = patch_at(after(kStart, 1));
    if (gray)
      cv::cvtColor(first, first, cv::COLOR_BGR2GRAY), cv::cvtColor(second, second, cv::COLOR_BGR2GRAY);
    const cv::Mat first_before = first.clone(), second_before = second.clone();
    auto tracker = started(first);
    tracker->track(frame_of(second, 1));
    EXPECT_EQ(cv::norm(first, first_before, cv::NORM_L1), 0.0);
    EXPECT_EQ(cv::norm(second, second_before, cv::NORM_L1), 0.0);
  }
}

TEST_P(EveryTracker, CannotTrackBeforeItIsStarted) {
  const cv::Mat picture = patch_at(kStart);
  EXPECT_THROW(make()->track(frame_of(picture, 0)), Error);
}

TEST_P(EveryTracker, IsNotStartedTwice) {
  const cv::Mat picture = patch_at(kStart);
  auto tracker = started(picture);
  EXPECT_THROW(tracker->start(frame_of(picture, 1), patch_box(kStart)), Error);
  tracker->track(frame_of(picture, 1));
  EXPECT_THROW(tracker->start(frame_of(picture, 2), {20, 20, 60, 60}), Error);
  EXPECT_TRUE(tracker->track(frame_of(picture, 2)));  // the refused start has not disturbed it
}

TEST_P(EveryTracker, RefusesABoxThatIsNone) {
  const cv::Mat picture = patch_at(kStart);
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const Box box : {Box{40, 46, 0, 20}, Box{40, 46, 20, 0}, Box{40, 46, -20, 20}, Box{nan, 46, 20, 20},
                        Box{40, 46, 20, nan}, Box{40, 46, inf, 20}, Box{-inf, 46, 20, 20}})
    EXPECT_THROW(make()->start(frame_of(picture, 0), box), Error);
}

TEST_P(EveryTracker, SaysOnlyBoxesThatAreFiniteAndTouchThePicture) {
  // Flat, black, white, noise and a bare wall after the start.
  cv::Mat3b noise(120, 160);
  cv::RNG(3).fill(noise, cv::RNG::UNIFORM, 0, 256);
  auto tracker = started(patch_at(kStart));
  FrameIndex index = 0;
  for (const cv::Mat& odd : {cv::Mat(cv::Mat3b(120, 160, cv::Vec3b::all(0))), cv::Mat(noise),
                             cv::Mat(bare_wall()), cv::Mat(cv::Mat3b(120, 160, cv::Vec3b::all(255)))}) {
    const auto sighting = tracker->track(frame_of(odd, ++index));
    if (!sighting) continue;
    EXPECT_TRUE(well_formed(sighting->outline));
    EXPECT_GT(share_inside(sighting->outline, picture_box({160, 120})), 0.0);
  }
}

TEST_P(EveryTracker, CanBeStartedOnAFlatPicture) {
  const cv::Mat flat = cv::Mat3b(120, 160, cv::Vec3b::all(90));
  auto tracker = started(flat);
  const cv::Mat next = patch_at(kStart);
  const auto sighting = tracker->track(frame_of(next, 1));
  EXPECT_TRUE(!sighting || well_formed(sighting->outline));
}

TEST_P(EveryTracker, TakesColourAfterGreyAndGreyAfterColour) {
  for (const bool start_gray : {false, true}) {
    cv::Mat gray;
    const cv::Mat colour = patch_at(kStart);
    cv::cvtColor(colour, gray, cv::COLOR_BGR2GRAY);
    auto tracker = started(start_gray ? gray : colour);
    for (FrameIndex i = 1; i <= 4; ++i)
      EXPECT_NO_THROW(tracker->track(frame_of(i % 2 == 1 ? gray : colour, i)));
  }
}

TEST_P(EveryTracker, IsNotDisturbedByAnotherOneAtWork) {
  if (!GetParam().deterministic) GTEST_SKIP() << "no two runs of it are the same";
  std::vector<std::optional<Sighting>> alone, beside;
  for (auto* answers : {&alone, &beside}) {
    auto tracker = started(patch_at(kStart));
    auto other = make();
    const cv::Mat elsewhere = patch_at({90, 20});
    if (answers == &beside) other->start(frame_of(elsewhere, 0), patch_box({90, 20}));
    for (int i = 1; i <= 4; ++i) {
      const cv::Mat picture = patch_at(after(kStart, i));
      answers->push_back(tracker->track(frame_of(picture, i)));
      if (answers == &beside) other->track(frame_of(picture, i));
    }
  }
  EXPECT_EQ(alone, beside);
}

TEST_P(EveryTracker, RefusesPicturesThatAreEmpty) {
  if (GetParam().name == "still" || GetParam().name == "linear") GTEST_SKIP() << "it takes no notice";
  const cv::Mat picture = patch_at(kStart);
  EXPECT_THROW(make()->start(Frame{}, patch_box(kStart)), Error);
  auto tracker = started(picture);
  EXPECT_THROW(tracker->track(Frame{}), Error);
  EXPECT_TRUE(tracker->track(frame_of(picture, 2)));  // and goes on with the next
}

TEST_P(EveryTracker, TakesAnyHint) {
  const cv::Mat picture = patch_at(kStart);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Box prior : {patch_box(kStart), Box{nan, 0, 1, 1}, Box{0, 0, 0, 0}, Box{-1e9, 1e9, 1e-9, 1e9}}) {
    auto tracker = make();
    EXPECT_NO_THROW(tracker->expect(prior, 1));
    tracker->start(frame_of(picture, 0), patch_box(kStart));
    EXPECT_NO_THROW(tracker->expect(prior, nan));
    EXPECT_NO_THROW(tracker->track(frame_of(picture, 1)));
  }
}

TEST(BuiltinTrackers, HaveASentenceForThemselvesAndForEveryOption) {
  for (const TrackerEntry& entry : registry().entries()) {
    EXPECT_FALSE(entry.sentence.empty()) << entry.name;
    for (const OptionInfo& option : entry.options)
      EXPECT_FALSE(option.sentence.empty()) << entry.name << ", " << option.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Trackers, EveryTracker, testing::ValuesIn(ready()),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace relock
