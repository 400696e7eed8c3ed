#include "trackers/builtin.h"

#include "trackers/opencv_tracker.h"
#include "trackers/yardsticks.h"

namespace relock {
namespace {

void add_opencv(Registry<TrackerEntry>& registry) {
  if (has_contributed_trackers()) {
    registry.add({.name = "kcf",
                  .sentence = "kernelized correlation filter, OpenCV's; the box keeps its size",
                  .options = kcf_option_list(),
                  .make = [](const Options& o, std::uint64_t) { return kcf_tracker(kcf_options(o)); }});
    registry.add({.name = "csrt",
                  .sentence = "correlation filter with channel and spatial reliability, OpenCV's",
                  .options = csrt_option_list(),
                  .make = [](const Options& o, std::uint64_t) { return csrt_tracker(csrt_options(o)); }});
  }
  registry.add({.name = "mil",
                .sentence = "online multiple-instance learning, OpenCV's; the box keeps its size",
                .options = mil_option_list(),
                .deterministic = false,  // the library seeds itself from the clock
                .make = [](const Options& o, std::uint64_t) { return mil_tracker(mil_options(o)); }});
}

void add_yardsticks(Registry<TrackerEntry>& registry) {
  registry.add({.name = "still",
                .sentence = "says the start box for ever",
                .make = [](const Options&, std::uint64_t) { return still_tracker(); }});
  registry.add({.name = "linear",
                .sentence = "moves the start box at the velocity that matching the start patch in the first "
                            "frames gives",
                .options = linear_option_list(),
                .make = [](const Options& o, std::uint64_t) { return linear_tracker(linear_options(o)); }});
}

}  // namespace

void add_builtin_trackers(Registry<TrackerEntry>& registry) {
  add_opencv(registry);
  add_yardsticks(registry);
}

}  // namespace relock
