#include "cli/method_spec.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/random.h"

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

TEST(MethodSpec, NestsCombinationsAndReadsBackWhatItWrites) {
  for (const char* text :
       {"detect(ring)", "track(kcf)", "hybrid(ring,kcf,doubt=0.3)", "blur-predict(kcf,ring,exposure_ms=8)",
        "guarded(gap-aware(kcf(resize=false)),ring(geometry=paper),every=5,patience=2)"}) {
    const auto specs = parse_methods(text);
    ASSERT_EQ(specs.size(), 1u);
    EXPECT_EQ(specs[0].text(), text);
    EXPECT_EQ(parse_methods(specs[0].text()), specs);
  }
  const auto two = parse_methods(" hybrid( ring , kcf( a = 1 ) , doubt = 0.3 ) , kcf");
  ASSERT_EQ(two.size(), 2u);
  EXPECT_EQ(two[0].text(), "hybrid(ring,kcf(a=1),doubt=0.3)");
}

/// What parse_methods says against the text.
std::string complaint_about(const std::string& text) {
  try {
    parse_methods(text);
  } catch (const Error& fault) {
    return fault.what();
  }
  ADD_FAILURE() << text << " was taken";
  return {};
}

TEST(MethodSpec, PointsAtTheCharacterOfAMistakeWithinCombinations) {
  for (const auto& [text, place] : {std::pair{"hybrid(ring,kcf", 16},
                                    {"hybrid(,kcf)", 8},
                                    {"hybrid(ring kcf(a),b)", 18},
                                    {"guarded(kcf(a=1,,ring)", 17},
                                    {"hybrid(doubt=1,kcf)", 19},
                                    {"track(kcf))", 11}})
    EXPECT_NE(complaint_about(text).find("character " + std::to_string(place) + ":"), std::string::npos)
        << complaint_about(text);
}

TEST(MethodSpec, OffersTheNearestCombination) {
  EXPECT_NE(complaint_about("hybird(ring,kcf)").find("did you mean \"hybrid\"?"), std::string::npos);
}

TEST(MethodSpec, RefusesDeepNestsInsteadOfFallingIntoThem) {
  std::string text;
  for (int i = 0; i < 100000; ++i) text += "track(";
  EXPECT_NE(complaint_about(text).find("nested at most"), std::string::npos);
}

TEST(MethodSpec, TakesOrRefusesWhateverIsTypedAndReadsBackWhatItTook) {
  const std::vector<std::string> words{"kcf", "hybrid", "gap-aware", "(", "(", ")",    ")",
                                       ",",   ",",      "=",         " ", "a", "\xff", "ring"};
  Random random(1);
  int taken = 0, refused = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string text = random.chance(0.5) ? "hybrid(ring" : "";
    for (auto left = random.below(12); left > 0; --left) text += words[random.below(words.size())];
    try {
      const auto specs = parse_methods(text);
      ++taken;
      for (const MethodSpec& spec : specs) EXPECT_EQ(parse_methods(spec.text()), std::vector{spec}) << text;
    } catch (const Error& fault) {
      ++refused;
      EXPECT_TRUE(std::string_view(fault.what()).starts_with("methods, character ")) << fault.what();
    }
  }
  EXPECT_GT(taken, 100);
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace relock
