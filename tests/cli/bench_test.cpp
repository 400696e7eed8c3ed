#include "cli/bench/bench.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "cli/bench/rows.h"
#include "cli/method_spec.h"
#include "cli/print/targets.h"
#include "core/random.h"
#include "detectors/builtin.h"
#include "tests/fault.h"

namespace relock::bench {
namespace {

const Methods& built_in() {
  static const Methods methods = [] {
    Methods all;
    add_builtin_detectors(all.detectors);
    return all;
  }();
  return methods;
}

Measured measured(double value, Interval interval, const Goal& goal, std::size_t pictures = 5000) {
  return {"row", "what", "%", value, interval, pictures, goal};
}

TEST(BenchVerdict, IsTheBestLevelReached) {
  const Goal rate{Goal::Sense::least, 90, 95}, error{Goal::Sense::most, 2, 1};
  EXPECT_EQ(verdict_of(measured(97, {96, 98}, rate)), "aim");
  EXPECT_EQ(verdict_of(measured(93, {92, 94}, rate)), "must");
  EXPECT_EQ(verdict_of(measured(80, {75, 85}, rate)), "missed");
  EXPECT_EQ(verdict_of(measured(0.5, {0.4, 0.6}, error)), "aim");
  EXPECT_EQ(verdict_of(measured(1.5, {1.4, 1.6}, error)), "must");
  EXPECT_EQ(verdict_of(measured(3, {2.5, 4}, error)), "missed");
}

TEST(BenchVerdict, IsDoubtedWhereItMayBeChance) {
  const Goal rate{Goal::Sense::least, 90, 95};
  EXPECT_EQ(verdict_of(measured(97, {90, 99}, rate)), "aim?");
  EXPECT_EQ(verdict_of(measured(92, {85, 96}, rate)), "must?");
  EXPECT_EQ(verdict_of(measured(88, {80, 94}, rate)), "missed?");
}

TEST(BenchVerdict, NeedsThePicturesThatItIsAbout) {
  const Goal none{Goal::Sense::most, 0, 0, 3000, 10000};
  EXPECT_EQ(verdict_of(measured(0, {0, 1}, none, 2999)), "too few");
  EXPECT_EQ(verdict_of(measured(0, {0, 1}, none, 3000)), "must");
  EXPECT_EQ(verdict_of(measured(0, {0, 1}, none, 10000)), "aim");
  EXPECT_EQ(verdict_of(measured(0.5, {0.1, 1}, none, 10)), "missed");
}

TEST(BenchMedian, IntervalHoldsTheTrueMedianAboutAsOftenAsItSays) {
  Random random(7);
  int held = 0;
  for (int trial = 0; trial < 400; ++trial) {
    std::vector<double> values;
    for (int i = 0; i < 41; ++i) values.push_back(std::exp(random.normal()));  // median 1
    const Measured m = median("", "", "", values, {});
    held += m.interval->low <= 1 && 1 <= m.interval->high;
  }
  EXPECT_GE(held, 370);
  EXPECT_LE(held, 398);
}

TEST(BenchPictures, OfOddAndEvenSeedsHaveNothingInCommon) {
  const std::vector<PrintedTarget> targets{print_target("ring:01", 0.15)};
  for (const char* name : {"a", "b"}) {
    const auto odd = stills(name, {}, targets, Seeds::odd).make(0),
               even = stills(name, {}, targets, Seeds::even).make(0);
    EXPECT_GT(cv::norm(odd.pixels, even.pixels, cv::NORM_INF), 0);
    EXPECT_NE(*odd.truth.centre_projected, *even.truth.centre_projected);
  }
}

TEST(BenchPictures, AreJudgedByTheEvaluator) {
  const std::vector<PrintedTarget> targets{print_target("ring:01", 0.15), print_target("ring:10", 0.15)};
  const PictureKind kind = canvas("kind", 150, 40, targets, Seeds::even);
  const MadePicture picture = kind.make(1);
  const double length = norm(*picture.truth.blur);
  const auto look_of = [&](const std::string& code, Vec2 off) {
    Sighting said{.centre = *picture.truth.centre_projected + off,
                  .centre_kind = CentreKind::projected,
                  .outline = *picture.truth.outline,
                  .code = Code{"ring2", code}};
    said.blur = BlurEstimate{std::atan2(-picture.truth.blur->y, -picture.truth.blur->x) + 0.01, 1.1 * length};
    return judged(picture, kind, {said});
  };
  const Look right = look_of("10", {1, 0});
  EXPECT_TRUE(right.recognised);
  EXPECT_EQ(right.wrong, 0);
  EXPECT_NEAR(*right.centre_px, 1, 1e-9);
  EXPECT_NEAR(*right.direction_deg, 0.573, 1e-2);
  EXPECT_NEAR(*right.length_percent, 10, 1e-6);
  const Look wrong = look_of("01", {1, 0});
  EXPECT_EQ(wrong.wrong, 1);
  EXPECT_FALSE(wrong.recognised);
  const Look elsewhere = look_of("10", {140, 0});
  EXPECT_FALSE(elsewhere.recognised);
  EXPECT_EQ(elsewhere.wrong, 1);
}

TEST(Bench, FindsTheRingsOfItsOwnOptions) {
  const Bench three({parse_methods("ring(bits=3,geometry=even)").front()}, built_in());
  ASSERT_EQ(three.targets().size(), 8U);
  EXPECT_EQ(three.targets()[3].code, (Code{"ring3", "011"}));
  EXPECT_NE(
      fault_of([] { Bench({parse_methods("aruco").front()}, built_in()); }).find("no detector of rings"),
      std::string::npos);
}

TEST(Bench, MeasuresTheSameForAnyNumberOfJobs) {
  const auto rate = [](int jobs) {
    Settings settings;
    settings.pictures = 6, settings.jobs = jobs, settings.seeds = Seeds::even;
    Bench bench(settings, built_in());
    const auto row =
        std::find_if(rows().begin(), rows().end(), [](const Row& r) { return r.name == "sizes"; });
    std::vector<std::pair<std::optional<double>, std::optional<Interval>>> values;
    for (const Measured& m : row->measure(bench)) values.emplace_back(m.value, m.interval);
    return values;
  };
  EXPECT_EQ(rate(1), rate(2));
}

}  // namespace
}  // namespace relock::bench
