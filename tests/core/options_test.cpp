#include "core/options.h"

#include <gtest/gtest.h>

#include <array>

#include "core/error.h"
#include "core/nearest.h"
#include "core/random.h"
#include "tests/fault.h"

namespace relock {
namespace {

const std::vector<OptionInfo> kKnown{
    {"padding", "2.5", "", ""}, {"resize", "true", "", ""}, {"mode", "a", "", ""}};

TEST(Options, HaveTheirDefaultsUnlessGiven) {
  const Options options("kcf", kKnown, {{"padding", "3"}});
  EXPECT_EQ(options.number("padding", 0, 10), 3);
  EXPECT_TRUE(options.flag("resize"));
}

TEST(Options, NameOptionValueAndLegalRangeWhenRefused) {
  const Options options("kcf", kKnown, {{"padding", "30"}, {"resize", "yes"}});
  EXPECT_EQ(fault_of([&] { options.number("padding", 0, 10); }),
            "kcf: option padding is \"30\"; it must be a number from 0 to 10");
  EXPECT_EQ(fault_of([&] { options.flag("resize"); }),
            "kcf: option resize is \"yes\"; it must be one of false, true");
}

TEST(Options, OfferTheNearestName) {
  EXPECT_EQ(fault_of([] {
              Options("kcf", kKnown, {{"paddign", "1"}});
            }),
            "kcf has no option \"paddign\" (did you mean \"padding\"?); it has padding, resize, mode");
}

TEST(NearestName, IsOfferedForAMistypedLetterAndNotForSomethingElse) {
  const std::vector<std::string> known{"csrt", "kcf", "aruco"};
  EXPECT_EQ(nearest_name("crst", known), "csrt");
  EXPECT_EQ(nearest_name("kfc", known), "kcf");
  EXPECT_EQ(nearest_name("tracker", known), "");
}

TEST(Random, GivesTheSameNumbersEverywhere) {
  Random random(1);  // SplitMix64's own first outputs for the seed 1
  EXPECT_EQ(random.next(), 0x910a2dec89025cc1u);
  EXPECT_EQ(random.next(), 0xbeeb8da1658eec67u);
}

TEST(Random, FavoursNoRemainder) {
  Random random(5);
  std::array<int, 6> count{};
  for (int i = 0; i < 60000; ++i) ++count[random.below(6)];
  for (const int n : count) EXPECT_NEAR(n, 10000, 400);
}

}  // namespace
}  // namespace relock
