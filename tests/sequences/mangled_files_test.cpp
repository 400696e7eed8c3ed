#include <sstream>

#include "sequences/labels.h"
#include "sequences/timestamps.h"
#include "tests/mangled.h"

namespace relock {
namespace {

Recording recording_of(int frames) {
  Recording recording;
  recording.name = "made";
  recording.picture = {640, 360};
  recording.period = period_of(30);
  for (int k = 0; k < frames; ++k) recording.captured.push_back(Time{k * recording.period});
  return recording;
}

TEST(MangledTimestamps, AreTakenOrRefusedInASentence) {
  expect_taken_or_refused("frame,timestamp_ns\n0,0\n1,33333333\n2,66666667\n3,133333333\n", "timestamps.csv",
                          [](const std::string& copy) {
                            std::istringstream in(copy);
                            read_timestamps(in, "timestamps.csv");
                          });
}

TEST(MangledLabels, AreTakenOrRefusedInASentence) {
  const std::string right =
      "frame,target,label,x,y,width,height,blur_x,blur_y,sigma_px\n"
      "0,a,visible,100,50,40,40,3,0,0.5\n0,\"b, c\",absent,,,,,,,\n1,a,visible,104,50,40,40,3,0,0.5\n"
      "2,a,unlabelled,,,,,,,\n2,\"b, c\",visible,10,20,30.5,30,,,1\n";
  expect_taken_or_refused(right, "labels.csv", [](const std::string& copy) {
    std::istringstream in(copy);
    Recording recording = recording_of(3);
    read_labels(in, "labels.csv", {}, {}, recording);
  });
}

}  // namespace
}  // namespace relock
