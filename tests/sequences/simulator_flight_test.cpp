// Flights as recordings: whole or not there, the same bytes again, and read like any other.

#include "sequences/simulator/flight.h"

#include <fstream>
#include <map>
#include <sstream>

#include <gtest/gtest.h>

#include "core/error.h"
#include "sequences/open.h"
#include "tests/sequences/scratch.h"

namespace relock::simulator {
namespace {

namespace fs = std::filesystem;

/// A grey sheet with a black square: no marker, but a target.
PrintedTarget square(std::string_view name, double size_m) {
  PrintedTarget printed{.name = std::string(name), .size_m = size_m, .sheet_m = 1.4 * size_m};
  printed.picture = cv::Mat(256, 256, CV_8UC1, cv::Scalar(230));
  const int margin = static_cast<int>(256 * 0.2 / 1.4);
  printed.picture(cv::Rect(margin, margin, 256 - 2 * margin, 256 - 2 * margin)).setTo(10);
  return printed;
}

FlightPlan brief(const std::string& preset = "ardrone") {
  FlightPlan plan = flight_preset(preset);
  plan.camera.width = 160, plan.camera.height = 120;
  plan.duration_s = 0.4;
  plan.exposure.most_steps = 6;
  plan.scene.clutter = 0.2;
  plan.targets = {{"square"}};
  return plan;
}

std::map<std::string, std::string> files_in(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    std::ifstream in(entry.path(), std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    files[fs::relative(entry.path(), folder).string()] = text.str();
  }
  return files;
}

TEST(Flight, IsTheSameForAnyNumberOfJobsAndAgainFromItsOwnPlan) {
  const Scratch scratch;
  fs::create_directory(scratch.path() / "a"), fs::create_directory(scratch.path() / "b");
  fs::create_directory(scratch.path() / "c");
  const FlightPlan plan = brief("rolling");
  fly(plan, square, scratch.path() / "a/flight", {.jobs = 1});
  fly(plan, square, scratch.path() / "b/flight", {.jobs = 3});
  const auto first = files_in(scratch.path() / "a/flight");
  EXPECT_EQ(first.size(), 12 + 6);
  EXPECT_EQ(first, files_in(scratch.path() / "b/flight"));
  fly(read_flight_plan(scratch.path() / "a/flight/flight.toml"), square, scratch.path() / "c/flight");
  EXPECT_EQ(first, files_in(scratch.path() / "c/flight"));
}

TEST(Flight, IsARecordingLikeAnyOther) {
  const Scratch scratch;
  FlightPlan plan = brief();
  plan.timing.gaps = "periodic(4,1)";
  plan.timing.jitter_ms = 3;
  const FlightSummary flown = fly(plan, square, scratch.path() / "flight");
  const Sequence sequence = open_sequence(scratch.path() / "flight");
  EXPECT_EQ(sequence.recording.frames(), static_cast<std::size_t>(flown.frames));
  EXPECT_EQ(flown.frames, 9);
  EXPECT_EQ(flown.lost, 3);
  EXPECT_EQ(sequence.recording.targets.size(), 1u);
  EXPECT_EQ(sequence.recording.targets[0].size_m, 0.15);
  EXPECT_EQ(sequence.recording.truth_of(0, 0).label, Label::visible);
}

TEST(Flight, OfAnotherSeedIsAnother) {
  const Scratch scratch;
  FlightPlan plan = brief();
  fly(plan, square, scratch.path() / "one");
  plan.seed = 2;
  fly(plan, square, scratch.path() / "two");
  EXPECT_NE(files_in(scratch.path() / "one")["labels.csv"], files_in(scratch.path() / "two")["labels.csv"]);
}

TEST(Flight, GrowsDarkerOrSlowerAsLightFalls) {
  FlightPlan plan = flight_preset("dusk");
  const Motion motion(plan.motion, 1);
  const Exposure first(plan.exposure, motion, 0, 0), half(plan.exposure, motion, 5, 0.5),
      last(plan.exposure, motion, 10, 1);
  EXPECT_LT(first.duration_s(), half.duration_s());
  EXPECT_LT(half.duration_s(), last.duration_s());
  EXPECT_EQ(first.gain(), 1);
  EXPECT_GT(last.gain(), 1);
  EXPECT_NEAR(last.gain() * last.light(), 1, 1e-12);
}

TEST(Flight, LeavesNothingWhenItCannotBeFlown) {
  const Scratch scratch;
  FlightPlan plan = brief();
  plan.scene.background = scratch.path() / "none.jpg";
  EXPECT_THROW(fly(plan, square, scratch.path() / "flight"), Error);
  plan = brief();
  plan.exposure.time_ms = -1;
  EXPECT_THROW(fly(plan, square, scratch.path() / "flight"), Error);
  plan = brief();
  plan.exposure.time_ms = 50;
  EXPECT_THROW(fly(plan, square, scratch.path() / "flight"), Error);
  plan = brief();
  plan.camera.k1 = -3;
  EXPECT_THROW(fly(plan, square, scratch.path() / "flight"), Error);
  EXPECT_TRUE(fs::is_empty(scratch.path()));
  EXPECT_THROW(fly(brief(), square, "/proc/flight"), Error);
}

TEST(Flight, IsNotWrittenOverAnother) {
  const Scratch scratch;
  fs::create_directory(scratch.path() / "flight");
  EXPECT_THROW(fly(brief(), square, scratch.path() / "flight"), Error);
}

TEST(FlightPlan, OfEveryPresetIsTheSameAfterWritingAndReading) {
  const Scratch scratch;
  for (const FlightPreset& preset : flight_presets()) {
    const std::string text = flight_plan_text(preset.plan);
    scratch.write("plan.toml", text);
    EXPECT_EQ(flight_plan_text(read_flight_plan(scratch.path() / "plan.toml")), text) << preset.name;
  }
}

TEST(FlightPlan, NamesLineAndColumnOfAMistake) {
  const Scratch scratch;
  const auto fault_of = [&](const std::string& text) -> std::string {
    scratch.write("plan.toml", text);
    try {
      read_flight_plan(scratch.path() / "plan.toml");
    } catch (const Error& fault) {
      return fault.what();
    }
    return "nothing";
  };
  EXPECT_NE(fault_of("[exposure]\ntime = 3\n").find("plan.toml:2:1: no key is called \"time\""),
            std::string::npos);
  EXPECT_NE(fault_of("[motion]\npath = \"loop\"\n").find("plan.toml:2:8: path must be one of hover"),
            std::string::npos);
  EXPECT_NE(fault_of("preset = \"ardron\"\n").find("did you mean \"ardrone\"?"), std::string::npos);
  EXPECT_NE(fault_of("[exposure]\ntime_ms = -2\n").find("exposure: time_ms is -2"), std::string::npos);
}

}  // namespace
}  // namespace relock::simulator
