#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/detector.h"
#include "core/options.h"
#include "detectors/ring_marker.h"

namespace relock {

/// relock's own detector of ring markers (detectors/ring_marker.h): it finds lines across the picture that are
/// symmetric like a marker's, and fits to each place that has some the whole picture that a moving marker leaves.
/// docs/ring.md goes through it.
/// In what grey levels a blur is the mean of what was exposed.
enum class RingTone : std::uint8_t {
  automatic,  ///< whichever explains a marker better
  coded,  ///< in the picture's own: it was blurred afterwards, or its grey levels are proportional to light
  light,  ///< in light, which the picture has in sRGB's coding: most cameras
};
enum class RingRefinement : std::uint8_t {
  none,
  ceres,  ///< what was read is fitted once more to every pixel, and says how sure it is
};

struct RingOptions {
  int bits = 2;
  std::string geometry = "paper";  ///< as ring_geometry() takes it
  double quiet_zone = 1.3;         ///< radius up to which the sheet is black, parts of R
  bool inverted = false;           ///< black rings on white
  double min_diameter_px = 16;     ///< smallest marker looked for, along the line on which it is shortest
  int max_candidates = 4;  ///< places looked at closely in vain; more is slower and finds more in clutter
  bool colours =
      false;  ///< tell the sheet's colour, too: codes are "01" and "01-red"; needs pictures in colour
  RingTone tone = RingTone::automatic;
  RingRefinement refine = RingRefinement::none;

  friend bool operator==(const RingOptions&, const RingOptions&) = default;
};

/// The options as `relock list --verbose` prints them, with the defaults of RingOptions.
std::vector<OptionInfo> ring_option_list();
/// Throws Error naming the option, the value and the legal range.
RingOptions ring_options(const Options& given);

/// Reads the family ring_family(bits). A sighting has as its centre the projected one, as its outline the outermost
/// ring's image in the middle of the exposure (an Ellipse), the code, the blur, and a confidence that falls from 1 with
/// what the fit leaves unexplained. Best first: the least left unexplained. With
/// RingRefinement::ceres also the covariances of centre and blur. Throws Error for a geometry that is none.
std::unique_ptr<Detector> ring_detector(const RingOptions& options);

}  // namespace relock
