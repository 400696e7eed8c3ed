#include "detectors/builtin.h"

#include "detectors/apriltag.h"
#include "detectors/aruco.h"

namespace relock {

void add_builtin_detectors(Registry<DetectorEntry>& registry) {
  registry.add({.name = "aruco",
                .sentence = "ArUco markers, found and read by OpenCV",
                .options = aruco_option_list(),
                .reads = [](const Options& o) { return std::vector{aruco_family(aruco_options(o))}; },
                .make = [](const Options& o, std::uint64_t) { return aruco_detector(aruco_options(o)); }});
  registry.add(
      {.name = "apriltag",
       .sentence = "AprilTags, found and read by libapriltag",
       .options = apriltag_option_list(),
       .reads = [](const Options& o) { return std::vector{apriltag_family(apriltag_options(o))}; },
       .make = [](const Options& o, std::uint64_t) { return apriltag_detector(apriltag_options(o)); }});
}

}  // namespace relock
