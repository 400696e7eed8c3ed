#include "cli/combinations.h"

#include <gtest/gtest.h>

#include <tuple>

#include "core/error.h"
#include "tests/fault.h"

namespace relock {
namespace {

Methods built_in() { return builtin_methods(); }

ChosenMethod chosen(const std::string& text, const Methods& methods) {
  return choose(methods, parse_methods(text).at(0));
}

std::string refusal(const std::string& text) {
  const Methods methods = built_in();
  return fault_of([&] { chosen(text, methods); });
}

TEST(Combinations, AreThoseThatTheGrammarKnows) {
  std::vector<std::string> names;
  for (const CombinationInfo& info : combinations()) names.push_back(info.name);
  EXPECT_EQ(names, combination_names());
}

TEST(Combinations, SayInASentenceWhatTheyNeed) {
  EXPECT_EQ(refusal("hybrid(csrt,aruco)"), "hybrid needs a detector and then a tracker; csrt is a tracker");
  EXPECT_EQ(refusal("hybrid(aruco)"),
            "hybrid needs a detector and then a tracker; hybrid(aruco) has 1 method");
  EXPECT_EQ(refusal("guarded(kcf,hybrid(aruco,kcf))"),
            "guarded needs a tracker and then a detector; hybrid(aruco,kcf) is a whole method of its own");
  EXPECT_EQ(refusal("track(oracle)"), "track needs a tracker; oracle is an end of the scale");
  EXPECT_NE(refusal("gap-aware").find("needs a tracker"), std::string::npos);
  EXPECT_NE(refusal("track(gap-aware(kfc))").find("did you mean \"kcf\"?"), std::string::npos);
  EXPECT_NE(refusal("hybrid(aruco,kcf,dubt=1)").find("did you mean \"doubt\"?"), std::string::npos);
  EXPECT_NE(refusal("guarded(kcf,aruco,apart=-1)").find("from 0 to 100"), std::string::npos);
  EXPECT_NE(refusal("gap-aware(kcf(resize=maybe))").find("resize"), std::string::npos);
  EXPECT_NE(refusal("blur-predict(kcf,exposure_ms=soon)").find("exposure_ms"), std::string::npos);
}

TEST(Combinations, TellTheOptionsOfTheirPartsAndDefaultsToo) {
  const Methods methods = built_in();
  const auto method = chosen("guarded(gap-aware(kcf(resize=false),spread=0.2),aruco,every=5)", methods);
  EXPECT_EQ(method.options.at("every"), "5");
  EXPECT_EQ(method.options.at("doubt"), "0");
  EXPECT_EQ(method.options.at("gap-aware.spread"), "0.2");
  EXPECT_EQ(method.options.at("gap-aware.kcf.resize"), "false");
  EXPECT_EQ(method.options.count("aruco.dictionary"), 1u);
}

TEST(Combinations, KnowHowTheyMayBeRun) {
  const Methods methods = built_in();
  for (const auto& [text, takes, needs, reads] : {std::tuple{"detect(aruco)", false, false, true},
                                                  {"track(kcf)", true, true, false},
                                                  {"hybrid(aruco,kcf)", true, false, true},
                                                  {"guarded(kcf,aruco)", true, true, true},
                                                  {"blur-predict(kcf,aruco)", true, true, false}}) {
    const auto method = chosen(text, methods);
    EXPECT_EQ(method.takes_boxes, takes) << text;
    EXPECT_EQ(method.needs_start, needs) << text;
    EXPECT_EQ(method.reads_codes, reads) << text;
    EXPECT_EQ(method.make(Recording(), 1)->takes_boxes(), takes) << text;
  }
  EXPECT_FALSE(chosen("hybrid(aruco,mil)", methods).deterministic);
  EXPECT_TRUE(is_detection(methods, parse_methods("detect(aruco)").at(0)));
  EXPECT_FALSE(is_detection(methods, parse_methods("hybrid(aruco,kcf)").at(0)));
}

TEST(Combinations, HonourHintsAsTheirTrackerDoes) {
  const Methods methods = built_in();
  const auto honours = [&](const char* text) {
    return bound_tracker(methods, parse_methods(text).at(0)).entry.honours_expect;
  };
  EXPECT_TRUE(honours("gap-aware(flow)"));
  EXPECT_FALSE(honours("gap-aware(kcf)"));
}

TEST(Combinations, KnowTheTrackerInThem) {
  const auto tracker = [](const std::string& text) -> std::string {
    const auto found = tracker_in(parse_methods(text).front());
    return found ? found->text() : "none";
  };
  EXPECT_EQ(tracker("guarded(gap-aware(kcf(resize=false),margin=0.2),ring)"), "kcf(resize=false)");
  EXPECT_EQ(tracker("hybrid(ring,blur-predict(blut,ring))"), "blut");
  EXPECT_EQ(tracker("track(csrt)"), "csrt");
  EXPECT_EQ(tracker("detect(ring)"), "none");
  EXPECT_EQ(with_tracker(parse_methods("guarded(gap-aware(kcf,margin=0.2),ring)").front(), "T").text(),
            "guarded(gap-aware(T,margin=0.2),ring)");
}

}  // namespace
}  // namespace relock
