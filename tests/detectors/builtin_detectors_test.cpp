#include "detectors/builtin.h"

#include <gtest/gtest.h>

namespace relock {
namespace {

TEST(BuiltinDetectors, CanAllBeMadeWithTheDefaultsTheyList) {
  Registry<DetectorEntry> registry;
  add_builtin_detectors(registry);
  EXPECT_EQ(registry.names(), (std::vector<std::string>{"aruco", "apriltag", "ring", "ring-paper"}));
  for (const DetectorEntry& entry : registry.entries()) {
    const Options defaults(entry.name, entry.options, {});
    EXPECT_NE(entry.make(defaults, 1), nullptr) << entry.name;
    EXPECT_FALSE(entry.sentence.empty()) << entry.name;
    for (const OptionInfo& option : entry.options) EXPECT_FALSE(option.sentence.empty()) << option.name;
  }
}

TEST(BuiltinDetectors, ReadTheFamilyThatTheirOptionsChoose) {
  Registry<DetectorEntry> registry;
  add_builtin_detectors(registry);
  const auto reads = [&](const char* name, const std::map<std::string, std::string>& given) {
    const DetectorEntry& entry = *registry.find(name);
    return entry.reads(Options(name, entry.options, given));
  };
  EXPECT_EQ(reads("aruco", {}), std::vector<std::string>{"aruco6x6_250"});
  EXPECT_EQ(reads("aruco", {{"dictionary", "4x4_50"}}), std::vector<std::string>{"aruco4x4_50"});
  EXPECT_EQ(reads("apriltag", {}), std::vector<std::string>{"apriltag36h11"});
  EXPECT_EQ(reads("apriltag", {{"family", "tagStandard41h12"}}),
            std::vector<std::string>{"apriltagStandard41h12"});
  EXPECT_EQ(reads("ring-paper", {}), std::vector<std::string>{"ring2"});
  EXPECT_EQ(reads("ring-paper", {{"bits", "3"}}), std::vector<std::string>{"ring3"});
}

}  // namespace
}  // namespace relock
