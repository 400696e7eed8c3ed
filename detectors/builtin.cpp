#include "detectors/builtin.h"

#include "detectors/apriltag.h"
#include "detectors/aruco.h"
#include "detectors/ring.h"
#include "detectors/ring_marker.h"
#include "detectors/ring_paper.h"

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
  registry.add({.name = "ring",
                .sentence = "ring markers, by a fit of the whole blurred picture: blur, pose and code",
                .options = ring_option_list(),
                .reads = [](const Options& o) { return std::vector{ring_family(ring_options(o).bits)}; },
                .make = [](const Options& o, std::uint64_t) { return ring_detector(ring_options(o)); }});
  registry.add(
      {.name = "ring-paper",
       .sentence = "ring markers under motion blur, as the paper that proposed them finds them",
       .options = ring_paper_option_list(),
       .reads = [](const Options& o) { return std::vector{ring_family(ring_paper_options(o).bits)}; },
       .make = [](const Options& o, std::uint64_t) { return ring_paper_detector(ring_paper_options(o)); }});
}

}  // namespace relock
