#include "cli/map/boundary.h"

#include <gtest/gtest.h>

#include "cli/json_text.h"
#include "cli/map/answer.h"
#include "core/error.h"
#include "tests/cli/synthetic_map.h"

namespace relock::maps {
namespace {

const std::vector<double> kAxis{1, 2, 4, 6, 8, 12};

/// Differences that all seeds agree on but for `spread`.
std::vector<Estimate> sure(const std::vector<double>& values, double spread = 0.01) {
  std::vector<Estimate> all;
  for (const double value : values) all.push_back({value, {spread, -spread, spread, -spread}});
  return all;
}

TEST(Isotonic, LeavesWhatRisesAndPoolsWhatFalls) {
  EXPECT_EQ(isotonic(std::vector<double>{1, 2, 3}), (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(isotonic(std::vector<double>{3, 1, 2}), (std::vector<double>{2, 2, 2}));
  EXPECT_EQ(isotonic(std::vector<double>{1, 4, 2, 5}), (std::vector<double>{1, 3, 3, 5}));
}

TEST(TheBoundary, IsWhereTheDifferencePassesThroughZero) {
  const auto boundary = boundary_of(kAxis, sure({0.5, 0.4, 0.2, -0.2, -0.4, -0.5}));
  ASSERT_TRUE(boundary);
  EXPECT_NEAR(boundary->at, 5, 1e-9);
  EXPECT_EQ(boundary->before, Ahead::tracking);
  EXPECT_LT(boundary->low.value(), 5);
  EXPECT_GT(boundary->high.value(), 5);
}

TEST(TheBoundary, IsFoundWhicheverLeadsFirst) {
  const auto boundary = boundary_of(kAxis, sure({-0.5, -0.4, -0.2, 0.2, 0.4, 0.5}));
  ASSERT_TRUE(boundary);
  EXPECT_NEAR(boundary->at, 5, 1e-9);
  EXPECT_EQ(boundary->before, Ahead::detection);
}

TEST(TheBoundary, IsNoneWhereOneLeadsThroughout) {
  EXPECT_FALSE(boundary_of(kAxis, sure({0.5, 0.4, 0.3, 0.2, 0.1, 0.1})));
  EXPECT_FALSE(boundary_of(kAxis, sure({0, 0, 0, 0, 0, 0})));
  EXPECT_FALSE(boundary_of(kAxis, sure({0, 0, -0.1, -0.3, -0.4, -0.5})));
}

TEST(TheBoundary, OfATieBetweenTwoLeadsIsItsMiddle) {
  EXPECT_NEAR(boundary_of(kAxis, sure({0.5, 0.1, 0, 0, 0, -0.5}))->at, 6, 1e-9);
}

TEST(TheBoundary, IsOpenWhereNobodyIsAheadBeyondDoubt) {
  const auto boundary = boundary_of(kAxis, sure({0.1, 0.1, 0.05, -0.3, -0.4, -0.5}, 0.2));
  ASSERT_TRUE(boundary);
  EXPECT_FALSE(boundary->low);
  EXPECT_TRUE(boundary->high);
}

TEST(TheBoundary, HasAnIntervalThatCoversTheUndecidedCellsAboutIt) {
  // Seeds disagree at 6 and at 8, and one against the other: the mean of the two alone would be decided.
  auto differences = sure({0.5, 0.4, 0.2, -0.2, -0.2, -0.5});
  differences[3].departures = {0.5, -0.5, 0.5, -0.5};
  differences[4].departures = {-0.5, 0.5, -0.5, 0.5};
  const auto boundary = boundary_of(kAxis, differences);
  ASSERT_TRUE(boundary);
  EXPECT_GT(boundary->high.value(), 8);
}

TEST(TheBoundary, IsNoneWhereNoiseAlonePassesThroughZero) {
  EXPECT_FALSE(boundary_of(kAxis, sure({0.01, 0.01, 0, -0.01, -0.02, -0.02}, 0.2)));
}

TEST(TheBoundary, TakesOneCellOutOfLineForNoise) {
  const auto boundary = boundary_of(kAxis, sure({0.5, -0.02, 0.4, -0.3, -0.4, -0.5}));
  ASSERT_TRUE(boundary);
  EXPECT_GT(boundary->at, 4);
  EXPECT_LT(boundary->at, 6);
}

TEST(TheBoundary, OfAKnownMapLiesWithinItsIntervalNineteenTimesInTwenty) {
  constexpr std::uint64_t kMaps = 400;
  double held = 0, found = 0;
  for (std::uint64_t draw = 1; draw <= kMaps; ++draw) {
    const Answer told = answer(known_map(0.05, draw), {}, {});
    if (!told.rows[0].boundary) continue;
    const Boundary& boundary = *told.rows[0].boundary;
    found += 1;
    held += (!boundary.low || *boundary.low <= 5) && (!boundary.high || *boundary.high >= 5);
  }
  EXPECT_EQ(found, kMaps);
  EXPECT_GE(held / found, 0.93);
  EXPECT_LE(held / found, 0.99);
}

TEST(AnAnswer, SaysWhoLeadsWhereThereIsNoBoundary) {
  const Answer told = answer(known_map(0.02, 3), {}, {});
  EXPECT_FALSE(told.rows[1].boundary);
  EXPECT_EQ(told.rows[1].leads, Ahead::tracking);
  const std::string text = text_of(known_map(0.02, 3), told);
  EXPECT_NE(text.find("tracking (follow) beats detection (find) up to gaps of"), std::string::npos) << text;
  EXPECT_NE(text.find("T  T  T  T  T   T\n"), std::string::npos) << text;
  EXPECT_NE(text.find("beats detection (find) at gaps of 1, 2, 4, 6, 8, 12 slots"), std::string::npos)
      << text;
}

TEST(AnAnswer, IsAboutTheTwoThatWereNamed) {
  MeasuredMap map = known_map(0.02, 3);
  map.methods.push_back(known_method(
      "worse", MethodClass::tracker, map.plan, [](auto...) { return 0.0; }, 0, 1));
  map.ceilings.push_back(map.ceilings.front());
  EXPECT_EQ(answer(map, {}, {}).tracker, "follow");
  EXPECT_EQ(answer(map, "worse", {}).tracker, "worse");
  EXPECT_THROW(answer(map, "find", {}), Error);
}

TEST(TheBoundary, PassesOverPlacesWhereNobodySeesTheTarget) {
  auto differences = sure({0.5, 0.4, 0.2, -0.2, -0.4, -0.5});
  differences[1] = differences[5] = {{}, {{}, {}, {}, {}}};
  EXPECT_NEAR(boundary_of(kAxis, differences).value().at, 5, 1e-9);
  EXPECT_FALSE(boundary_of(kAxis, std::vector<Estimate>(6)));
}

TEST(AMapsFiles, SayNothingOfACellInWhichTheTargetIsNeverVisible) {
  const MeasuredMap map = with_a_blind_cell(known_map(0.02, 3));
  const Answer told = answer(map, {}, {});
  const std::string csv = csv_of(map, told), json = json_of(map, told), text = text_of(map, told);
  EXPECT_NE(csv.find("follow,tracker,,,,,0.000000,0.000000,5,\n"), std::string::npos) << csv;
  EXPECT_NE(csv.find("follow - find,difference,,,,,,,5,\n"), std::string::npos) << csv;
  const Json read = Json::parse(json);
  const Json& cell = read["methods"][0]["locked_share"][0][0];
  for (const char* key : {"value", "low", "high", "ceiling"}) EXPECT_TRUE(cell.at(key).is_null()) << key;
  for (const char* key : {"value", "low", "high", "ahead"})
    EXPECT_TRUE(read["difference"][0][0].at(key).is_null()) << key;
  EXPECT_NE(text.find("n/a"), std::string::npos) << text;
}

TEST(AMapsFiles, HaveARowForEveryCellAndMethodAndForTheDifference) {
  const MeasuredMap map = known_map(0.02, 3);
  const std::string csv = csv_of(map, answer(map, {}, {}));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 2 * 6 * 3);
}

}  // namespace
}  // namespace relock::maps
