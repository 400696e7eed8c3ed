#include "cli/reproduce/contenders.h"

#include <fmt/format.h>

#include <set>

#include "cli/catalogue.h"
#include "cli/method_spec.h"

namespace relock::reproduction {

const RingMethod& own_ring_method() {
  static const RingMethod own{"ring", "by ring",
                              "ring is relock's own detector: it fits the blurred picture instead of "
                              "looking for its edges, so that blur of the rings' own width and more is "
                              "no limit. It was made long after the paper, to read its marker better."};
  return own;
}

const std::vector<RingMethod>& ring_methods() {
  static const std::vector<RingMethod> methods{
      {"ring-paper", "", ""},
      {"ring-paper(distance=pixels)", "pixels",
       "The paper puts components into one cluster up to a distance of 150 and does not say from where to "
       "where, and which codes last depends on it. Across the gaps between them, as ring-paper comes, 00 is "
       "read beyond 50 px, so that its loss is no limit of the picture. From pixel to pixel on average, "
       "ring-paper(distance=pixels), 00 is lost from 50 px on as printed, and the others at some angles, "
       "though they are printed to be found at all."},
      own_ring_method()};
  return methods;
}

const std::vector<std::string>& ring_codes() {
  static const std::vector<std::string> codes{"00", "01", "10", "11"};
  return codes;
}

std::string ring_target(const std::string& code) { return "ring:" + code; }

std::vector<Contender> contenders_of(const RingMethod& method) {
  std::vector<Contender> contenders;
  for (const std::string& code : ring_codes()) contenders.push_back({method.method, ring_target(code)});
  return contenders;
}

const std::vector<Contender>& square_markers() {
  static const std::vector<Contender> markers{
      {"aruco(dictionary=original)", "arucooriginal:7"},
      {"aruco(dictionary=4x4_50)", "aruco4x4_50:7"},
      {"aruco(dictionary=5x5_50)", "aruco5x5_50:7"},
      {"aruco(dictionary=6x6_250)", "aruco6x6_250:7"},
      {"aruco(dictionary=7x7_50)", "aruco7x7_50:7"},
      {"apriltag(family=tag16h5)", "apriltag16h5:7"},
      {"apriltag(family=tag25h9)", "apriltag25h9:7"},
      {"apriltag(family=tag36h11)", "apriltag36h11:7"},
      {"apriltag(family=tagStandard41h12)", "apriltagStandard41h12:7"},
      {"apriltag(family=tagCircle21h7)", "apriltagCircle21h7:7"},
  };
  return markers;
}

ChosenDetector choose_detector(const Methods& methods, const std::string& method) {
  const MethodSpec spec = parse_methods(method).front();
  const DetectorEntry& entry = detector_entry(methods, spec.name);
  return {&entry, Options(entry.name, entry.options, spec.options)};
}

bool is_built_in(const Methods& methods, const std::string& method) {
  return methods.detectors.find(parse_methods(method).front().name) != nullptr;
}

std::vector<Contender> squares_built_in(const Methods& methods) {
  std::vector<Contender> there;
  for (const Contender& marker : square_markers())
    if (is_built_in(methods, marker.method)) there.push_back(marker);
  return there;
}

std::vector<std::string> missing_methods(const Methods& methods, const std::vector<std::string>& asked) {
  std::vector<std::string> sentences;
  std::set<std::string> told;
  for (const std::string& method : asked) {
    const std::string name = parse_methods(method).front().name;
    if (!is_built_in(methods, name) && told.insert(name).second)
      sentences.push_back(
          fmt::format("There is no detector {} in this relock; what it would have found is left out.", name));
  }
  return sentences;
}

}  // namespace relock::reproduction
