#include <gtest/gtest.h>

#include "core/random.h"
#include "tests/core/scripted.h"

namespace relock {
namespace {

const Code kOne{"fake", "1"}, kTwo{"fake", "2"};

struct Stage {
  Sightings detections;
  int looks = 0;
  std::shared_ptr<ScriptedTracker::Log> log = std::make_shared<ScriptedTracker::Log>();
  std::unique_ptr<Method> method;

  explicit Stage(const GuardedOptions& options) {
    method = guarded(scripted([](FrameIndex, const Box& from) { return sighting_of(from); }, log),
                     std::make_unique<ScriptedDetector>([this] { return ++looks, detections; }), options);
    method->start(frame_at(0), {"one", kOne}, box_at(50));
  }
};

TEST(Guarded, FollowsItsTrackerWhileTheDetectorAgrees) {
  Stage stage({.every = 5});
  stage.detections = {seen_at(54, kOne)};
  for (FrameIndex i = 1; i <= 50; ++i) EXPECT_EQ(stage.method->locate(frame_at(i)).at(0).centre.x, 50);
  EXPECT_EQ(stage.looks, 10);
  EXPECT_EQ(stage.log->starts.size(), 1u);
}

TEST(Guarded, IsCorrectedByADetectionElsewhereAtTheNextLook) {
  Stage stage({.every = 5});
  stage.detections = {seen_at(300, kOne)};
  for (FrameIndex i = 1; i <= 20; ++i) {
    const Sightings said = stage.method->locate(frame_at(i));
    ASSERT_EQ(said.size(), 1u);
    EXPECT_EQ(said[0].centre.x, i < 5 ? 50 : 300) << "frame " << i;
    EXPECT_EQ(said[0].track, "one");
  }
}

TEST(Guarded, DeclaresALossWithinItsPatienceAndAnswersAgainOnlyWhenDetected) {
  for (const double patience_s : {0.2, 0.5, 1.0, 3.0}) {
    Stage stage({.every = 10, .patience_s = patience_s});
    for (FrameIndex i = 1; i <= 200; ++i) {
      stage.detections = i == 180 ? Sightings{seen_at(400, kOne)} : Sightings{seen_at(52, kTwo)};
      const Sightings said = stage.method->locate(frame_at(i));
      const bool within = seconds(frame_at(i).captured) <= patience_s;
      const bool back = i >= 180 && seconds(frame_at(i).captured - frame_at(180).captured) <= patience_s;
      EXPECT_EQ(said.empty(), !within && !back) << "patience " << patience_s << ", frame " << i;
    }
  }
}

TEST(Guarded, LosesATargetThatAGapLeftUnconfirmed) {
  Stage stage({.every = 100, .patience_s = 1});
  EXPECT_EQ(stage.method->locate(frame_at(1)).size(), 1u);
  EXPECT_TRUE(stage.method->locate(frame_at(61)).empty());
}

TEST(Guarded, WatchesEachOfSeveralTargetsOnItsOwn) {
  Stage stage({.every = 5, .patience_s = 0.5});
  stage.method->start(frame_at(0), {"two", kTwo}, box_at(90));
  stage.detections = {seen_at(90, kTwo)};
  Sightings said;
  for (FrameIndex i = 1; i <= 60; ++i) said = stage.method->locate(frame_at(i));
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0].track, "two");
}

}  // namespace
}  // namespace relock
