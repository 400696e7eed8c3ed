#include "core/plugin.h"

#include <gtest/gtest.h>

#include <array>
#include <numbers>
#include <stdexcept>

namespace relock {
namespace {

/// What a plug-in's function answers, as its caller keeps it.
struct Heard {
  std::vector<Sighting> sightings;
  std::string error;
  relock_answer table{sizeof(relock_answer),
                      this,
                      [](void* host, const relock_sighting* seen) {
                        static_cast<Heard*>(host)->sightings.push_back(plugin::from_c(*seen));
                      },
                      nullptr,
                      [](void* host, const char* sentence) { static_cast<Heard*>(host)->error = sentence; },
                      nullptr};
};

class ThrowsAlways final : public Detector {
 public:
  Sightings detect(const Image& image, const std::optional<Box>&) override {
    if (image.empty()) throw 7;
    throw std::runtime_error("not today");
  }
};

const Sighting kFull{.centre = {10.25, 20.5},
                     .centre_kind = CentreKind::projected,
                     .outline = Box{1.5, 2.5, 30, 40},
                     .code = Code{"aruco6x6_250", "23"},
                     .confidence = 0.75,
                     .blur = BlurEstimate{0.5, 12}};

TEST(PluginExchange, GivesBackASightingAsItWas) {
  const Quad quad{{Vec2{1, 2}, Vec2{30, 3}, Vec2{31, 40}, Vec2{2, 41}}};
  const Ellipse ellipse{{50, 60}, 20, 10, std::numbers::pi / 3};
  for (const Outline& outline : {Outline{Box{1, 2, 3, 4}}, Outline{quad}, Outline{ellipse}}) {
    Sighting sighting = kFull;
    sighting.outline = outline;
    EXPECT_EQ(plugin::from_c(plugin::to_c(sighting)), sighting);
    EXPECT_EQ(plugin::from_c(plugin::to_c(sighting_of(outline))), sighting_of(outline));
  }
}

TEST(PluginExchange, GivesBackAFrameAsItWas) {
  const std::array<std::uint8_t, 24> pixels{};
  const Frame frame{42, time_ns(1'400'000'000), Image(pixels.data(), {2, 3}, PixelFormat::bgr8, 8)};
  const Frame back = plugin::from_c(plugin::to_c(frame));
  EXPECT_EQ(back.index, frame.index);
  EXPECT_EQ(back.captured, frame.captured);
  EXPECT_EQ(back.image.size(), frame.image.size());
  EXPECT_EQ(back.image.format(), frame.image.format());
  EXPECT_EQ(back.image.stride(), 8u);
  EXPECT_EQ(back.image.row(2), frame.image.row(2));
  EXPECT_TRUE(plugin::from_c(plugin::to_c(Image{})).empty());
}

TEST(PluginExchange, RefusesWhatIsNoSighting) {
  const relock_sighting good = plugin::to_c(kFull);
  relock_sighting bad = good;
  bad.outline_kind = 9;
  EXPECT_THROW(plugin::from_c(bad), Error);
  bad = good, bad.centre_kind = 9;
  EXPECT_THROW(plugin::from_c(bad), Error);
  bad = good, bad.size = 8;
  EXPECT_THROW(plugin::from_c(bad), Error);
  bad = good, bad.code_value = nullptr;
  EXPECT_THROW(plugin::from_c(bad), Error);
}

TEST(Plugin, LetsNoExceptionOut) {
  const Plugin made("bad", [](Plugin& plugin) {
    plugin.detector({.name = "bad", .sentence = "", .make = [](const Options&, std::uint64_t) {
                       return std::make_unique<ThrowsAlways>();
                     }});
  });
  const relock_method& method = made.table()->methods[0];
  Heard heard;
  void* object = method.create(method.own, nullptr, 0, 1, &heard.table);
  const std::uint8_t pixel = 0;
  const relock_image picture = plugin::to_c(Image(&pixel, {1, 1}, PixelFormat::gray8, 1)), none{};
  method.detect(object, &picture, nullptr, &heard.table);
  EXPECT_EQ(heard.error, "not today");
  method.detect(object, &none, nullptr, &heard.table);
  EXPECT_EQ(heard.error, "it threw something that is no exception");
  EXPECT_TRUE(heard.sightings.empty());
  method.destroy(object);
}

TEST(Plugin, TellsOfARegistrationThatThrowsAndBringsNothing) {
  const Plugin made("bad", [](Plugin& plugin) {
    plugin.detector({.name = "bad", .sentence = "", .make = {}});
    throw Error("there is no such camera");
  });
  EXPECT_STREQ(made.table()->error, "there is no such camera");
  EXPECT_EQ(made.table()->method_count, 0u);
}

}  // namespace
}  // namespace relock
