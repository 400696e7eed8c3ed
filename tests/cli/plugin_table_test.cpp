#include "cli/plugins/table.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "cli/recordings.h"
#include "core/error.h"
#include "core/plugin.h"

namespace relock {
namespace {

/// Answers with what it was given: where it is told to look, and its options and seed in the code.
class Echo final : public Detector {
 public:
  explicit Echo(std::string said) : said_(std::move(said)) {}
  Sightings detect(const Image& image, const std::optional<Box>& where) override {
    Sighting sighting = sighting_of(where.value_or(picture_box(image.size())));
    sighting.code = Code{"echo", said_};
    return {sighting, sighting};
  }

 private:
  std::string said_;
};

/// Says where it was started or was last told to expect the target; nothing on frame 3.
class Follow final : public Tracker {
 public:
  void start(const Frame&, const Box& box) override { box_ = box; }
  std::optional<Sighting> track(const Frame& frame) override {
    if (frame.index == 3) return std::nullopt;
    if (frame.captured == time_ns(5)) throw Error("five is too late");
    return sighting_of(box_);
  }
  void expect(const Box& prior, double sigma_px) override { box_ = {prior.x, prior.y, sigma_px, sigma_px}; }

 private:
  Box box_;
};

const Plugin& both() {
  static const Plugin made("both", [](Plugin& plugin) {
    plugin.detector(
        {.name = "echo",
         .sentence = "what it is told",
         .options = {{"first", "1", "px", "a number"}, {"second", "two", "", "a word"}},
         .reads = [](const Options& given) { return std::vector<std::string>{given.word("second")}; },
         .make =
             [](const Options& given, std::uint64_t seed) {
               return std::make_unique<Echo>(given.word("first") + given.word("second") +
                                             std::to_string(seed));
             }});
    plugin.tracker({.name = "follow",
                    .sentence = "where it is told",
                    .deterministic = false,
                    .honours_expect = true,
                    .make = [](const Options&, std::uint64_t) { return std::make_unique<Follow>(); }});
  });
  return made;
}

const std::uint8_t kPixels[12] = {};
const Image kPicture(kPixels, {4, 3}, PixelFormat::gray8, 4);

TEST(PluginTable, MakesEntriesThatSayWhatThePluginSays) {
  const Methods methods = methods_of(both().table(), {"libboth.so", "abc"});
  const DetectorEntry& echo = methods.detectors.entries().at(0);
  EXPECT_EQ(echo.name, "echo");
  EXPECT_EQ(echo.options.at(1).default_value, "two");
  EXPECT_EQ(echo.options.at(0).unit, "px");
  EXPECT_EQ(echo.plugin.value().fingerprint, "abc");
  EXPECT_EQ(echo.reads(Options("echo", echo.options, {{"second", "tags"}})),
            std::vector<std::string>{"tags"});
  const TrackerEntry& follow = methods.trackers.entries().at(0);
  EXPECT_FALSE(follow.deterministic);
  EXPECT_TRUE(follow.honours_expect);
}

TEST(PluginTable, CarriesOptionsSeedAndAnswersThrough) {
  const Methods methods = methods_of(both().table(), {});
  const DetectorEntry& echo = methods.detectors.entries().at(0);
  const auto detector = echo.make(Options("echo", echo.options, {{"first", "8"}}), 77);
  const Sightings whole = detector->detect(kPicture);
  ASSERT_EQ(whole.size(), 2u);
  EXPECT_EQ(to_string(whole[0].code.value()), "echo:8two77");
  EXPECT_EQ(whole[0].outline, Outline(picture_box({4, 3})));
  EXPECT_EQ(detector->detect(kPicture, Box{1, 1, 2, 2})[0].outline, Outline(Box{1, 1, 2, 2}));
}

TEST(PluginTable, CarriesATrackersLifeThrough) {
  const Methods methods = methods_of(both().table(), {});
  const auto tracker = methods.trackers.entries().at(0).make(Options(), 1);
  tracker->start({0, time_ns(0), kPicture}, Box{1, 1, 2, 2});
  EXPECT_EQ(tracker->track({1, time_ns(1), kPicture}).value().outline, Outline(Box{1, 1, 2, 2}));
  EXPECT_FALSE(tracker->track({3, time_ns(3), kPicture}));
  tracker->expect(Box{2, 1, 2, 2}, 4.5);
  EXPECT_EQ(tracker->track({4, time_ns(4), kPicture}).value().outline, Outline(Box{2, 1, 4.5, 4.5}));
  EXPECT_THROW(tracker->track({5, time_ns(5), kPicture}), Error);
}

TEST(PluginTable, ReadsAPluginOfLaterDaysWhoseStructsAreLonger) {
  struct LongMethod {
    relock_method known;
    void* later[3] = {};
  };
  struct LongOption {
    relock_option known;
    const char* later = nullptr;
  };
  const LongOption options[2] = {{{"first", "1", "px", "a number"}}, {{"second", "2", "", "another"}}};
  relock_method echo = both().table()->methods[0];
  echo.options = &options[0].known;
  const LongMethod methods[2] = {{echo}, {both().table()->methods[1]}};
  relock_plugin table = *both().table();
  table.method_size = sizeof(LongMethod);
  table.option_size = sizeof(LongOption);
  table.methods = &methods[0].known;
  const Methods read = methods_of(&table, {});
  EXPECT_EQ(read.detectors.entries().at(0).options.at(1).name, "second");
  EXPECT_EQ(read.trackers.entries().at(0).name, "follow");
}

TEST(EmbeddedRecordings, AreBesideTheInstalledProgramElseInTheSources) {
  const auto prefix = std::filesystem::temp_directory_path() / ("relock-prefix-" + std::to_string(getpid()));
  std::filesystem::create_directories(prefix / "share/relock/recordings");
  EXPECT_EQ(embedded_recordings(prefix / "bin/relock"), prefix / "share/relock/recordings");
  EXPECT_TRUE(std::filesystem::exists(embedded_recordings(prefix / "elsewhere/bin/relock") / "klahaag"));
  std::filesystem::remove_all(prefix);
}

}  // namespace
}  // namespace relock
