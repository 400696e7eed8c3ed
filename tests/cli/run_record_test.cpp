#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "cli/runs/folder.h"
#include "cli/runs/plan.h"
#include "core/error.h"

namespace relock {
namespace {

RunRecord some_record() {
  RunRecord record;
  record.recording = "flight";
  record.method = "kcf";
  record.gaps = "none";
  return record;
}

TEST(ARunRecord, KeepsItsAnchorAndItsRealTime) {
  RunRecord record = some_record();
  record.protocol = Protocol::multistart;
  record.anchor = Anchor{50, Direction::backward};
  record.real_time = "queue(3)";
  record.latency = "constant(20ms)";
  const RunRecord read = parse_record(to_json_text(record), "run.json");
  EXPECT_EQ(read.anchor, record.anchor);
  EXPECT_EQ(read.real_time, "queue(3)");
  EXPECT_TRUE(read.same_inputs(record));
}

TEST(RunsInOneTable, WerePlayedFromOneAnchorAndAtOneLatency) {
  const RunRecord record = some_record();
  for (int changed = 0; changed < 4; ++changed) {
    RunRecord other = record;
    if (changed == 0) other.anchor = Anchor{0, Direction::forward};
    if (changed == 1) other.real_time = "latest";
    if (changed == 2) other.latency = "measured";
    if (changed == 3) other.method = "csrt";
    EXPECT_EQ(other.same_conditions(record), changed == 3);
  }
}

TEST(AComparison, IsNamedAfterItsAnchorAndItsRealTime) {
  RunRecord record = some_record();
  record.protocol = Protocol::multistart;
  record.anchor = Anchor{50, Direction::backward};
  EXPECT_EQ(run_folder("out", record), "out/flight/recorded-multistart-0050-backward/kcf");
  EXPECT_EQ(spoken(record.showing()), "protocol multistart from frame 50 backward");
  record = some_record();
  record.real_time = "queue(3)";
  record.latency = "constant(20ms)";
  EXPECT_EQ(run_folder("out", record), "out/flight/recorded-once-queue-3-constant-20ms/kcf");
  EXPECT_EQ(spoken(record.showing()), "protocol once, real time queue(3), latency constant(20ms)");
}

TEST(ALatencyFile, IsKnownByItsContent) {
  const auto path = std::filesystem::path(testing::TempDir()) / "latencies.csv";
  std::ofstream(path) << "frame,wall_ms\n0,5\n";
  const std::string before = parse_real_time("latest", path.string()).latency.text;
  std::ofstream(path) << "frame,wall_ms\n0,6\n";
  const std::string after = parse_real_time("latest", path.string()).latency.text;
  EXPECT_NE(before, after);
  EXPECT_TRUE(before.starts_with("latencies.csv "));
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace relock
