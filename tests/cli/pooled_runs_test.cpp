#include "cli/pooled_runs.h"

#include <gtest/gtest.h>

namespace relock {
namespace {

/// One run of a recording without any target.
StoredComparison comparison(const std::string& gaps, const Showing& showing, bool yardstick = false) {
  StoredComparison made;
  made.recording.name = "a";
  made.recording.period = period_of(30);
  StoredRun run;
  run.record.method = yardstick ? "oracle" : "mine";
  run.record.yardstick = yardstick;
  run.record.gaps = gaps;
  run.record.protocol = showing.protocol;
  run.record.anchor = showing.anchor;
  run.record.real_time = showing.real_time;
  run.record.latency = showing.latency;
  made.runs.push_back(run);
  return made;
}

Showing real_time(const std::string& queue, const std::string& latency) {
  return {Protocol::once, {}, queue, latency};
}

TEST(PooledRuns, KeepRealTimeApartAndSaySo) {
  const std::vector<StoredComparison> all{
      comparison("none", {}), comparison("none", real_time("latest", "measured")),
      comparison("none", real_time("queue(2)", "measured")),
      comparison("none", real_time("latest", "constant(70ms)")), comparison("none", {})};
  const auto groups = pooled(all, {});
  ASSERT_EQ(groups.size(), 4u);
  EXPECT_EQ(groups[0].methods.at(0).runs.size(), 1u);  // the other is a copy
  EXPECT_EQ(heading(groups[0]), "protocol once, as recorded, gate centre 0.25 D, hold 0.5 D");
  EXPECT_EQ(
      heading(groups[3]),
      "protocol once, real time latest, latency constant(70ms), as recorded, gate centre 0.25 D, hold 0.5 D");
}

TEST(PooledRuns, PutAllAnchorsTogetherButNoOtherProtocolOrGaps) {
  const Showing ahead{Protocol::multistart, Anchor{0, Direction::forward}, {}, {}};
  const Showing back{Protocol::multistart, Anchor{50, Direction::backward}, {}, {}};
  const std::vector<StoredComparison> all{comparison("none", ahead), comparison("none", back),
                                          comparison("none", {Protocol::reset, {}, {}, {}}),
                                          comparison("paper", ahead)};
  const auto groups = pooled(all, {});
  ASSERT_EQ(groups.size(), 3u);
  EXPECT_EQ(groups[0].methods.at(0).runs.size(), 2u);
  EXPECT_EQ(heading(groups[2]), "protocol multistart, gaps paper, gate centre 0.25 D, hold 0.5 D");
}

TEST(PooledRuns, HaveTheirYardsticksLast) {
  const std::vector<StoredComparison> all{comparison("none", {}, true), comparison("none", {})};
  const auto groups = pooled(all, {});
  ASSERT_EQ(groups.at(0).methods.size(), 2u);
  EXPECT_EQ(groups[0].methods[0].method, "mine");
  EXPECT_TRUE(groups[0].methods[1].yardstick);
}

}  // namespace
}  // namespace relock
