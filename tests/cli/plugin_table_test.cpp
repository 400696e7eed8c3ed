#include "cli/plugins/table.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstddef>
#include <cstring>
#include <filesystem>
#include <functional>

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

/// Shows the picture that it was given and a chart of where it was told to look.
class Shows final : public ExplainingDetector {
 public:
  Sightings detect(const Image&, const std::optional<Box>&) override { return {}; }
  std::vector<Stage> explain(const Image& image, const std::optional<Box>& where) override {
    if (image.size().width == 1) throw Error("it is too narrow");
    const Box box = where.value_or(Box{});
    return {
        {"given", "as it is", image},
        {"box", "where to look", Chart{"x [px]", "y [px]", {{"a", {{box.x, box.y}, {1, 2}}}, {"b", {}}}}}};
  }
};

const Plugin& showing() {
  static const Plugin made("showing", [](Plugin& plugin) {
    plugin.detector({.name = "shows", .sentence = "its stages", .make = [](const Options&, std::uint64_t) {
                       return std::make_unique<Shows>();
                     }});
  });
  return made;
}

std::unique_ptr<Detector> first_detector(const relock_plugin* table) {
  const DetectorEntry entry = methods_of(table, {}).detectors.entries().at(0);
  return entry.make(Options(entry.name, entry.options, {}), 1);
}

/// What is said of a stage that a plug-in in C shows.
std::string fault_of_stage(const relock_stage& stage) {
  static relock_stage shown;
  shown = stage;
  relock_method method = showing().table()->methods[0];
  method.explain = [](void*, const relock_image* image, const relock_box*, const relock_answer* answer) {
    if (image) answer->stage(answer->host, &shown);
    return 1;
  };
  relock_plugin table = *showing().table();
  table.methods = &method;
  const auto detector = first_detector(&table);
  const std::uint8_t pixel = 0;
  try {
    dynamic_cast<ExplainingDetector&>(*detector).explain(Image(&pixel, {1, 1}, PixelFormat::gray8, 1));
  } catch (const Error& fault) {
    return fault.what();
  }
  return "";
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

TEST(PluginTable, CarriesADetectorsStagesThrough) {
  const auto detector = first_detector(showing().table());
  auto& shows = dynamic_cast<ExplainingDetector&>(*detector);
  // Of a picture three pixels wide, in rows of four bytes.
  const std::uint8_t pixels[8] = {1, 2, 3, 99, 4, 5, 6, 99};
  const auto stages = shows.explain(Image(pixels, {3, 2}, PixelFormat::gray8, 4), Box{7, 8, 1, 1});
  ASSERT_EQ(stages.size(), 2u);
  EXPECT_EQ(stages[0].name + ": " + stages[0].sentence, "given: as it is");
  EXPECT_EQ(std::get<Picture>(stages[0].shown).pixels, (std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6}));
  const auto& chart = std::get<Chart>(stages[1].shown);
  EXPECT_EQ(chart.x + chart.y, "x [px]y [px]");
  ASSERT_EQ(chart.curves.size(), 2u);
  EXPECT_EQ(chart.curves[0].name, "a");
  EXPECT_EQ(chart.curves[0].points, (std::vector<Vec2>{{7, 8}, {1, 2}}));
  EXPECT_TRUE(chart.curves[1].points.empty());
  const std::uint8_t colours[6] = {1, 2, 3, 4, 5, 6};
  const auto coloured = shows.explain(Image(colours, {2, 1}, PixelFormat::bgr8, 6));
  EXPECT_EQ(std::get<Picture>(coloured[0].shown).pixels, (std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6}));
  EXPECT_THROW(shows.explain(Image(pixels, {1, 1}, PixelFormat::gray8, 4)), Error);
}

TEST(PluginTable, ShowsNoStagesOfADetectorThatHasNone) {
  EXPECT_EQ(dynamic_cast<ExplainingDetector*>(first_detector(both().table()).get()), nullptr);
}

TEST(PluginTable, ReadsAPluginOfFormerDaysWhoseMethodsHadNoStages) {
  constexpr std::size_t old_size = offsetof(relock_method, explain);
  for (const relock_plugin* today : {both().table(), showing().table()}) {
    std::vector<std::max_align_t> bytes(
        today->method_count * sizeof(relock_method) / sizeof(std::max_align_t) + 1);
    auto* methods = reinterpret_cast<char*>(bytes.data());
    for (std::uint64_t i = 0; i < today->method_count; ++i)
      std::memcpy(methods + i * old_size, &today->methods[i], old_size);
    relock_plugin table = *today;
    table.method_size = old_size;
    table.methods = reinterpret_cast<const relock_method*>(methods);
    const auto detector = first_detector(&table);
    EXPECT_EQ(detector->detect(kPicture).empty(), today == showing().table());
    EXPECT_EQ(dynamic_cast<ExplainingDetector*>(detector.get()), nullptr);
    EXPECT_EQ(methods_of(&table, {}).trackers.entries().size(), today->method_count - 1);
  }
}

TEST(PluginTable, TellsWhatIsWrongWithAStage) {
  const double points[2] = {1, 2};
  const relock_curve curve{"a", points, 1};
  const relock_stage picture{
      sizeof(relock_stage), "n", "s", {kPixels, 4, 4, 3, RELOCK_GRAY8, 0}, nullptr, nullptr, nullptr, 0};
  const relock_stage chart{sizeof(relock_stage), "n", "s", {}, "x", "y", &curve, 1};
  const auto changed = [](relock_stage stage, const std::function<void(relock_stage&)>& change) {
    change(stage);
    return fault_of_stage(stage);
  };
  EXPECT_EQ(fault_of_stage(picture) + fault_of_stage(chart), "");
  EXPECT_EQ(changed(picture, [](auto& s) { s.name = nullptr; }), "it shows a stage whose name is NULL");
  EXPECT_EQ(changed(picture, [](auto& s) { s.size = 8; }).find("it shows a stage of 8 bytes, not "), 0u);
  EXPECT_EQ(changed(picture, [](auto& s) { s.picture.stride = 3; }),
            "it shows a stage whose picture is none: 4 x 3 px of format 0, 3 bytes a row");
  EXPECT_NE(changed(picture, [](auto& s) { s.picture.format = 7; }).find("of format 7"), std::string::npos);
  EXPECT_NE(changed(picture, [](auto& s) { s.picture.height = -3; }).find("4 x -3 px"), std::string::npos);
  EXPECT_EQ(changed(chart, [](auto& s) { s.y = nullptr; }), "it shows a stage whose y is NULL");
  EXPECT_EQ(changed(chart, [](auto& s) { s.curves = nullptr; }), "it shows a stage whose curves are NULL");
  EXPECT_EQ(changed(chart,
                    [](auto& s) {
                      static const relock_curve no_points{"a", nullptr, 3};
                      s.curves = &no_points;
                    }),
            "it shows a stage whose points are NULL");
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
