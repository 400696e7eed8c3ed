#include <gtest/gtest.h>

#include "core/random.h"
#include "tests/core/scripted.h"

namespace relock {
namespace {

const Code kOne{"fake", "1"}, kTwo{"fake", "2"};

/// A hybrid whose detector sees what `detections` holds, and whose trackers stay where they were started.
struct Stage {
  Sightings detections;
  int looks = 0;
  std::shared_ptr<ScriptedTracker::Log> log = std::make_shared<ScriptedTracker::Log>();
  ScriptedTracker::Script script = [](FrameIndex, const Box& from) { return sighting_of(from); };
  std::unique_ptr<Method> method;

  void make(const HybridOptions& options = {}) {
    method = hybrid(std::make_unique<ScriptedDetector>([this] { return ++looks, detections; }),
                    scripted(script, log), options);
  }
};

TEST(Hybrid, AnswersWithTheDetectionAndTracksFromItWhereThereIsNone) {
  Stage stage;
  stage.make();
  stage.method->start(frame_at(0), {"a", kOne}, box_at(50));
  stage.detections = {seen_at(60, kOne)};
  EXPECT_EQ(stage.method->locate(frame_at(1)).at(0).centre.x, 60);
  stage.detections = {};
  const Sightings tracked = stage.method->locate(frame_at(2));
  ASSERT_EQ(tracked.size(), 1u);
  EXPECT_EQ(tracked[0].centre.x, 60);
  EXPECT_EQ(tracked[0].track, "a");
  EXPECT_EQ(stage.log->starts, (std::vector<FrameIndex>{0, 1})) << "from the frame of the detection";
}

TEST(Hybrid, HasTheTargetBackWithTheNextDetectionWhereverItIs) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    Random random(seed);
    Stage stage;
    stage.script = [&](FrameIndex, const Box& from) {
      return random.chance(0.5) ? std::optional<Sighting>() : sighting_of(from);
    };
    stage.make();
    stage.method->start(frame_at(0), {"a", kOne}, box_at(50));
    for (FrameIndex i = 1; i < 100; ++i) {
      const auto truth = static_cast<double>(random.below(1000));
      const bool detected = random.chance(0.3);
      stage.detections = detected ? Sightings{seen_at(truth, kOne)} : Sightings{};
      const Sightings said = stage.method->locate(frame_at(i));
      if (!detected) continue;
      EXPECT_EQ(said.at(0).centre.x, truth) << "seed " << seed << ", frame " << i;
    }
  }
}

TEST(Hybrid, LooksAtOnceAndSaysNothingWhenItsTrackerIsInDoubtAndNothingIsDetected) {
  Stage stage;
  stage.script = [](FrameIndex i, const Box& from) {
    Sighting sighting = sighting_of(from);
    sighting.confidence = i == 3 ? 0.2 : 0.9;
    return sighting;
  };
  stage.make({.doubt = 0.3, .every = 100});
  stage.method->start(frame_at(0), {"a"}, box_at(50));
  EXPECT_EQ(stage.method->locate(frame_at(2)).size(), 1u);
  EXPECT_EQ(stage.looks, 0);
  EXPECT_TRUE(stage.method->locate(frame_at(3)).empty());
  EXPECT_EQ(stage.looks, 1);
}

TEST(Hybrid, TellsTargetsApartByTheirCodesAndElseByTheirPlaces) {
  Stage stage;
  stage.make();
  stage.method->start(frame_at(0), {"one", kOne}, box_at(50));
  stage.method->start(frame_at(0), {"two", kTwo}, box_at(90));
  stage.detections = {seen_at(92, kOne), seen_at(52, kTwo)};  // they changed places
  for (const Sighting& said : stage.method->locate(frame_at(1)))
    EXPECT_EQ(said.centre.x, said.track == "one" ? 92 : 52);
  stage.detections = {seen_at(55), seen_at(95)};
  for (const Sighting& said : stage.method->locate(frame_at(2)))
    EXPECT_EQ(said.centre.x, said.track == "one" ? 95 : 55);
}

TEST(Hybrid, WorksWithoutABoxAndForgetsWhatIsDetectedNoMore) {
  Stage stage;
  stage.make({.patience_s = 0.5});
  EXPECT_TRUE(stage.method->locate(frame_at(0)).empty());
  stage.detections = {seen_at(60, kOne)};
  EXPECT_EQ(stage.method->locate(frame_at(1)).size(), 1u);
  stage.detections = {};
  int tracked = 0;
  for (FrameIndex i = 2; i < 60; ++i) {
    const Sightings said = stage.method->locate(frame_at(i));
    if (said.empty()) continue;
    ++tracked;
    EXPECT_EQ(said[0].track, std::nullopt);
  }
  EXPECT_GE(tracked, 14);
  EXPECT_LE(tracked, 16) << "half a second at 30 Hz";
}

TEST(Hybrid, PassesOnDetectionsThatAreNoneOfItsTargets) {
  Stage stage;
  stage.make();
  stage.method->start(frame_at(0), {"one", kOne}, box_at(50));
  stage.detections = {seen_at(52, kTwo)};
  const Sightings said = stage.method->locate(frame_at(1));
  ASSERT_EQ(said.size(), 2u);
  EXPECT_EQ(said[0].code, kTwo);
  EXPECT_EQ(said[0].track, std::nullopt);
  EXPECT_EQ(said[1].track, "one");
}

}  // namespace
}  // namespace relock
