#include "cli/method_spec.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace relock {
namespace {

TEST(MethodSpec, ListsMethodsWithTheirOptions) {
  const auto specs = parse_methods("kcf, csrt(psr_threshold=0.05 , b=x),aruco()");
  ASSERT_EQ(specs.size(), 3u);
  EXPECT_EQ(specs[0].text(), "kcf");
  EXPECT_EQ(specs[1].text(), "csrt(b=x,psr_threshold=0.05)");
  EXPECT_EQ(specs[2].text(), "aruco");
}

TEST(MethodSpec, ReadsBackWhatItWrites) {
  for (const char* text : {"kcf", "csrt(a=1,b=2)"}) EXPECT_EQ(parse_methods(text).at(0).text(), text);
}

TEST(MethodSpec, PointsAtTheCharacterOfAMistake) {
  for (const auto& [text, place] :
       {std::pair{"kcf,", 5}, {"kcf(a=1", 8}, {"kcf(a)", 6}, {"kcf)", 4}, {"kcf(a=1,a=2)", 12}}) {
    try {
      parse_methods(text);
      ADD_FAILURE() << text;
    } catch (const Error& fault) {
      EXPECT_NE(std::string(fault.what()).find("character " + std::to_string(place) + ":"), std::string::npos)
          << fault.what();
    }
  }
}

}  // namespace
}  // namespace relock
