#include <fmt/format.h>

#include "detectors/ring/detector.h"

namespace relock {

std::vector<OptionInfo> ring_option_list() {
  const RingOptions d;
  return {
      {"bits", fmt::format("{}", d.bits), "", "bits of the codes: 1 to 6"},
      {"geometry", d.geometry, "", "where the rings are: paper, even, or radii (relock marker has the same)"},
      {"quiet_zone", fmt::format("{}", d.quiet_zone), "",
       "radius up to which the sheet is black, parts of the outermost ring's"},
      {"inverted", d.inverted ? "true" : "false", "", "true: black rings on white"},
      {"min_diameter_px", fmt::format("{}", d.min_diameter_px), "px",
       "smallest marker looked for, along the line on which it is shortest"},
      {"max_candidates", fmt::format("{}", d.max_candidates), "",
       "places that are looked at closely in vain; more is slower and finds more in clutter"},
      {"colours", d.colours ? "true" : "false", "",
       "true: tell red, green and blue sheets, too; needs pictures in colour"},
      {"tone", "auto", "",
       "what a blur is the mean of: coded grey levels, light in sRGB's coding, or auto: what explains a "
       "marker better"},
      {"refine", "none", "",
       "ceres: what was read is fitted once more, to every pixel; more exact, and it says how exact"},
  };
}

RingOptions ring_options(const Options& given) {
  RingOptions o;
  o.bits = given.whole("bits", 1, kMostRingBits);
  o.geometry = given.word("geometry");
  o.quiet_zone = given.number("quiet_zone", 1, 4);
  o.inverted = given.flag("inverted");
  o.min_diameter_px = given.number("min_diameter_px", 15, 10000);
  o.max_candidates = given.whole("max_candidates", 1, 1000);
  o.colours = given.flag("colours");
  const std::string& tone = given.word("tone", {"auto", "coded", "light"});
  o.tone = tone == "coded" ? RingTone::coded : tone == "light" ? RingTone::light : RingTone::automatic;
  o.refine =
      given.word("refine", {"none", "ceres"}) == "ceres" ? RingRefinement::ceres : RingRefinement::none;
  ring_geometry(o.geometry, o.bits);  // throws if it is none
  return o;
}

std::unique_ptr<Detector> ring_detector(const RingOptions& options) {
  return std::make_unique<ring::RingDetector>(options);
}

}  // namespace relock
