#include "cli/map/sweep.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <set>

#include "cli/map/answer.h"
#include "cli/map/draw.h"
#include "core/error.h"
#include "sequences/gaps.h"
#include "tests/cli/synthetic_map.h"

namespace relock::maps {
namespace {

SweepPlan sweep(Across across) {
  SweepPlan plan;
  plan.across = across;
  plan.columns = default_columns(across);
  plan.flight = map_flight();
  return plan;
}

TEST(ASweep, FliesOncePerExposureAndSeedAndTakesGapsFromTheSameFlights) {
  for (const Across across : {Across::gap, Across::rate})
    EXPECT_EQ(flights_of(sweep(across)).size(), 5u * 5u);
  EXPECT_EQ(flights_of(sweep(Across::size)).size(), 5u * 5u * 5u);
}

TEST(ASweep, NamesNoTwoFlightsAlike) {
  std::set<std::string> names;
  for (const PlannedFlight& flight : flights_of(sweep(Across::size))) names.insert(flight.name);
  EXPECT_EQ(names.size(), 125u);
}

TEST(ASweep, MovesTheSameInEveryRow) {
  for (const PlannedFlight& flight : flights_of(sweep(Across::gap))) {
    simulator::FlightPlan still = flight.plan;
    still.exposure = map_flight().exposure;
    still.seed = map_flight().seed;
    EXPECT_EQ(simulator::flight_plan_text(still), simulator::flight_plan_text(map_flight()));
  }
}

TEST(ASweep, AsksForPatternsThatThereAre) {
  for (const Across across : {Across::gap, Across::rate, Across::size}) {
    const SweepPlan plan = sweep(across);
    check_sweep(plan);
    for (std::size_t column = 0; column < plan.columns.size(); ++column)
      GapPattern::parse(gaps_of(plan, column));
  }
  EXPECT_EQ(gaps_of(sweep(Across::gap), 2), "gaps(4,0.05)");
}

TEST(ASweep, RefusesWhatNoMapCanBe) {
  const auto refused = [](auto&& change) {
    SweepPlan plan = sweep(Across::gap);
    change(plan);
    EXPECT_THROW(check_sweep(plan), Error);
  };
  refused([](SweepPlan& plan) { plan.columns = {2, 1}; });
  refused([](SweepPlan& plan) { plan.columns = {1.5}; });
  refused([](SweepPlan& plan) { plan.exposures_ms = {40}; });  // longer than the period
  refused([](SweepPlan& plan) { plan.seeds = 0; });
  refused([](SweepPlan& plan) { plan.flight.duration_s = 0.2; });
  refused([](SweepPlan& plan) { plan.gap_share = 0; });
  refused([](SweepPlan& plan) { plan.flight.targets.push_back({}); });
  refused([](SweepPlan& plan) { plan.flight.timing.gaps = "paper"; });
}

TEST(ADrawnMap, HasNoColourWhereTheTargetIsNeverVisible) {
  const auto white_pixels = [](const MeasuredMap& map) {
    const std::string png = png_of(map, answer(map, {}, {}));
    const cv::Mat picture = cv::imdecode(std::vector<char>(png.begin(), png.end()), cv::IMREAD_GRAYSCALE);
    return cv::countNonZero(picture == 255);
  };
  const MeasuredMap blind = with_a_blind_cell(known_map(0, 1));
  MeasuredMap lost = blind;  // seen, and never locked
  for (MethodMap& method : lost.methods) method.cells[0][0].visible_s.assign(5, 10.0);
  EXPECT_GT(white_pixels(blind), white_pixels(lost) + 1000);
}

TEST(ADrawnMap, IsTheSameBytesForTheSameMapAndAnotherPictureForAnother) {
  const auto drawn = [](double noise) {
    const MeasuredMap map = known_map(noise, 3);
    const Answer told = answer(map, {}, {});
    return std::pair(svg_of(map, told), png_of(map, told));
  };
  EXPECT_TRUE(drawn(0.02) == drawn(0.02));  // too long to be shown
  EXPECT_TRUE(drawn(0.02).first != drawn(0.2).first);
  EXPECT_TRUE(drawn(0.02).second != drawn(0.2).second);
  EXPECT_TRUE(drawn(0.02).first.starts_with("<?xml"));
  EXPECT_TRUE(drawn(0.02).second.starts_with("\x89PNG"));
}

}  // namespace
}  // namespace relock::maps
