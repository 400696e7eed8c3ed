// Opens a recording and looks for AprilTags in its first picture, by an installed relock.

#include <cstdio>

#include "core/registry.h"
#include "detectors/builtin.h"
#include "eval/replay/yardsticks.h"
#include "sequences/open.h"
#include "trackers/builtin.h"

int main(int, char** argv) {
  const auto sequence = relock::open_sequence(argv[1]);
  relock::Registry<relock::DetectorEntry> detectors;
  relock::Registry<relock::TrackerEntry> trackers;
  relock::add_builtin_detectors(detectors);
  relock::add_builtin_trackers(trackers);
  const auto oracle = relock::oracle(sequence.recording);
  std::printf("%zu frames, %zu detectors, %zu trackers\n", sequence.recording.frames(),
              detectors.entries().size(), trackers.entries().size());
}
