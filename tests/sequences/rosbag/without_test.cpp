#include <gtest/gtest.h>

#include "sequences/open.h"
#include "tests/sequences/scratch.h"

namespace relock {
namespace {

TEST(RosBag, InABuildWithoutTheirLibraryIsToldWithWhatToInstall) {
  const Scratch scratch;
  scratch.write("flight.bag", "#ROSBAG V2.0\n");
  EXPECT_NE(
      fault_of([&] { open_sequence(scratch.path() / "flight.bag"); }).find("install librosbag-storage-dev"),
      std::string::npos);
}

}  // namespace
}  // namespace relock
