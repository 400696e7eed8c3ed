#include "cli/json_text.h"

#include <gtest/gtest.h>

#include <limits>

namespace relock {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(JsonText, WritesWhatIsNotKnownAsNullAndInfinityAsAWord) {
  EXPECT_EQ(json_text(number({})), "null\n");
  EXPECT_EQ(json_text(number(0.25)), "0.25\n");
  EXPECT_EQ(json_text(number(kInfinity)), "\"infinite\"\n");
  EXPECT_EQ(json_text(interval({})), "null\n");
  EXPECT_EQ(interval(Interval{2, kInfinity}), Json::parse(R"([2.0, "infinite"])"));
  EXPECT_EQ(interval(Interval{-kInfinity, 2}), Json::parse(R"(["-infinite", 2.0])"));
}

TEST(JsonText, KeepsKeysInTheirOrderAndCanBeReadWhateverALibrarySaid) {
  const std::string text = json_text({{"what", "caf\xe9"}, {"frame", 3}});
  EXPECT_EQ(text, "{\n  \"what\": \"caf\xef\xbf\xbd\",\n  \"frame\": 3\n}\n");
  EXPECT_EQ(Json::parse(text).at("frame"), 3);
}

}  // namespace
}  // namespace relock
