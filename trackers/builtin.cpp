#include "trackers/builtin.h"

#include "trackers/blut/tracker.h"
#include "trackers/dlib_tracker.h"
#include "trackers/flow_tracker.h"
#include "trackers/ivt/tracker.h"
#include "trackers/legacy_tracker.h"
#include "trackers/network_tracker.h"
#include "trackers/opencv_tracker.h"
#include "trackers/template_tracker.h"
#include "trackers/yardsticks.h"

namespace relock {
namespace {

std::string contributed_needs(bool there) { return there ? "" : "OpenCV's contributed modules"; }

void add_opencv(Registry<TrackerEntry>& registry) {
  const std::string needs = contributed_needs(has_contributed_trackers());
  registry.add({.name = "kcf",
                .sentence = "kernelized correlation filter, OpenCV's; the box keeps its size",
                .options = kcf_option_list(),
                .needs = needs,
                .make = [](const Options& o, std::uint64_t) { return kcf_tracker(kcf_options(o)); }});
  registry.add({.name = "csrt",
                .sentence = "correlation filter with channel and spatial reliability, OpenCV's",
                .options = csrt_option_list(),
                .needs = needs,
                .make = [](const Options& o, std::uint64_t) { return csrt_tracker(csrt_options(o)); }});
  registry.add({.name = "mil",
                .sentence = "online multiple-instance learning, OpenCV's; the box keeps its size",
                .options = mil_option_list(),
                .deterministic = false,  // the library seeds itself from the clock
                .make = [](const Options& o, std::uint64_t) { return mil_tracker(mil_options(o)); }});
}

void add_legacy(Registry<TrackerEntry>& registry) {
  const std::string needs = contributed_needs(has_legacy_trackers());
  registry.add({.name = "mosse",
                .sentence = "minimum output sum of squared error filter, OpenCV's; the box keeps its size",
                .known_faults = {{"follows",
                                  "it gives up targets that change a little: the threshold of its peak is "
                                  "written into the library"}},
                .needs = needs,
                .make = [](const Options&, std::uint64_t) { return mosse_tracker(); }});
  registry.add(
      {.name = "medianflow",
       .sentence = "forward-backward optical flow on a grid of points, OpenCV's",
       .options = medianflow_option_list(),
       .needs = needs,
       .make = [](const Options& o, std::uint64_t) { return medianflow_tracker(medianflow_options(o)); }});
  registry.add({.name = "tld",
                .sentence = "tracking, learning, detection, OpenCV's; searches the whole picture; slow",
                .deterministic = false,  // the library seeds itself from the clock
                .needs = needs,
                .make = [](const Options&, std::uint64_t) { return tld_tracker(); }});
  registry.add(
      {.name = "boosting",
       .sentence = "online AdaBoost, OpenCV's; the box keeps its size; slow",
       .options = boosting_option_list(),
       .known_faults = {{"threads",
                         "the library draws from one sequence in the whole process; every run of "
                         "relock has a process of its own"}},
       .needs = needs,
       .make = [](const Options& o, std::uint64_t) { return boosting_tracker(boosting_options(o)); }});
}

void add_networks(Registry<TrackerEntry>& registry) {
  registry.add({.name = "goturn",
                .sentence = "regression network, OpenCV's",
                .options = goturn_option_list(),
                .needs = goturn_needs(),
                .make = [](const Options& o, std::uint64_t) { return goturn_tracker(goturn_options(o)); }});
  registry.add(
      {.name = "dasiamrpn",
       .sentence = "siamese region proposal network, OpenCV's",
       .options = dasiamrpn_option_list(),
       .needs = dasiamrpn_needs(),
       .make = [](const Options& o, std::uint64_t) { return dasiamrpn_tracker(dasiamrpn_options(o)); }});
  registry.add({.name = "nano",
                .sentence = "NanoTrack, a small siamese network, OpenCV's",
                .options = nano_option_list(),
                .needs = nano_needs(),
                .make = [](const Options& o, std::uint64_t) { return nano_tracker(nano_options(o)); }});
  registry.add({.name = "vit",
                .sentence = "VitTrack, a small vision transformer, OpenCV's",
                .options = vit_option_list(),
                .needs = vit_needs(),
                .make = [](const Options& o, std::uint64_t) { return vit_tracker(vit_options(o)); }});
}

void add_others(Registry<TrackerEntry>& registry) {
  registry.add({.name = "dlib",
                .sentence = "correlation filter with scale, dlib's",
                .options = dlib_option_list(),
                .needs = has_dlib() ? "" : "the library dlib",
                .make = [](const Options& o, std::uint64_t) { return dlib_tracker(dlib_options(o)); }});
  registry.add(
      {.name = "template",
       .sentence = "the start patch, looked for in the whole picture; returns by itself",
       .options = template_option_list(),
       .make = [](const Options& o, std::uint64_t) { return template_tracker(template_options(o)); }});
  registry.add({.name = "flow",
                .sentence = "corners in the box, moved as most of them agree",
                .options = flow_option_list(),
                .honours_expect = true,
                .make = [](const Options& o, std::uint64_t) { return flow_tracker(flow_options(o)); }});
}

void add_particle_trackers(Registry<TrackerEntry>& registry) {
  registry.add(
      {.name = "blut",
       .sentence = "blur-driven tracker: sharp, blurred and trivial templates in a sparse sum; tells the "
                   "blur and looks along it",
       .options = blut_option_list(),
       .honours_expect = true,
       .make = [](const Options& o, std::uint64_t seed) { return blut_tracker(blut_options(o), seed); }});
  registry.add(
      {.name = "l1",
       .sentence = "sparse sum of sharp and trivial templates: what blut extends",
       .options = l1_option_list(),
       .honours_expect = true,
       .make = [](const Options& o, std::uint64_t seed) { return l1_tracker(l1_options(o), seed); }});
  registry.add(
      {.name = "ivt",
       .sentence = "incremental visual tracker: a mean look and the directions in which it varies",
       .options = ivt_option_list(),
       .honours_expect = true,
       .make = [](const Options& o, std::uint64_t seed) { return ivt_tracker(ivt_options(o), seed); }});
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
  add_legacy(registry);
  add_networks(registry);
  add_others(registry);
  add_particle_trackers(registry);
  add_yardsticks(registry);
}

}  // namespace relock
