#include "sequences/time_faults.h"

#include <gtest/gtest.h>

#include "tests/sequences/scratch.h"

namespace relock {
namespace {

TEST(TimeFaults, AreAllTimesThatDoNotRise) {
  const Scratch scratch;
  scratch.write("timestamps.csv", "timestamp_ns\n10\n20\n20\n5\n6\n");
  const auto faults = time_faults(scratch.path() / "timestamps.csv");
  ASSERT_EQ(faults.size(), 2u);
  EXPECT_EQ(faults[0].line, 4u);
  EXPECT_EQ(faults[1].line, 5u);
  EXPECT_EQ(ns(faults[1].before - faults[1].time + Time{}), 15);
}

TEST(TimeFaults, AreNoneInRisingTimesAndWithoutAFile) {
  const Scratch scratch;
  scratch.write("timestamps.csv", "timestamp_ns\n10\n20\n");
  EXPECT_TRUE(time_faults(scratch.path() / "timestamps.csv").empty());
  EXPECT_TRUE(time_faults(scratch.path() / "none.csv").empty());
}

}  // namespace
}  // namespace relock
