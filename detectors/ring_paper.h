#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/detector.h"
#include "core/options.h"

namespace relock {

// `ring-paper`: the detector of "A Motion Blur Resilient Fiducial for Quadcopter Imaging" (Prasad, Chandran,
// Brown, WACV 2015), section 3.3, step by step and with the constants printed there. docs/ring-paper.md goes
// through it, and says of everything that the paper leaves open what is done here and why.

/// What the response to the Gabor filters is divided by before the threshold.
enum class Normalisation : std::uint8_t {
  peak,  ///< its largest value in the picture
  edge,  ///< the response to an edge from black to white
};

/// How far apart two components are.
enum class ComponentDistance : std::uint8_t {
  centroids,  ///< their centroids
  pixels,     ///< their centroids, and a component counts in means as often as it has pixels
  gaps,       ///< from the one's upright box to the other's
};

/// How bright and dark are told apart along a profile.
enum class Binarisation : std::uint8_t {
  local,   ///< halfway between each bright turning point and its dark neighbours
  middle,  ///< halfway between the darkest and the brightest sample of the whole profile
};

/// Which training profiles a profile is compared with.
enum class Compared : std::uint8_t {
  all,    ///< those of every code
  count,  ///< those of codes with as many rings as were counted
};

/// A length in px is one in the picture. The first group is printed in the paper, the others are left open there.
struct RingPaperOptions {
  double wavelength_px = 8;  ///< lambda of the Gabor filters
  double aspect = 0.5;       ///< gamma
  double spread = 0.56;      ///< sigma, in wavelengths
  double threshold = 0.4;    ///< of the normalised response
  double linkage_px = 150;   ///< average distance up to which components are one cluster
  int neighbours = 5;        ///< K
  double training_blur_px = 40;

  int bits = 2;
  std::string geometry = "paper";  ///< as ring_geometry() reads it
  bool inverted = false;           ///< black rings on white

  int kernel_px = 55;  ///< side of the kernels, odd
  Normalisation normalisation = Normalisation::peak;
  double least_contrast = 20;  ///< of an edge that can be the peak, grey levels
  int least_area_px = 126;     ///< of a component
  int most_components = 1000;  ///< the largest ones are clustered
  ComponentDistance distance = ComponentDistance::gaps;
  int scan_lines = 3;
  double scan_spacing_px = 5;
  double margin_px = 16;  ///< how far the profile goes on beyond the cluster's box
  Binarisation binarisation = Binarisation::local;
  double prominence = 0.05;      ///< of a turning point, parts of the profile's range
  double width_tolerance = 0.4;  ///< of a bright stretch, parts of their mean width
  int samples = 100;             ///< of a profile that is compared
  double training_marker_px = 150;
  Compared compared = Compared::all;
  double farthest = 0.25;  ///< rms difference to the nearest training profile

  friend bool operator==(const RingPaperOptions&, const RingPaperOptions&) = default;
};

/// The options as `relock list --verbose` prints them, with the defaults of RingPaperOptions.
std::vector<OptionInfo> ring_paper_option_list();
/// Throws Error naming the option, the value and the legal range.
RingPaperOptions ring_paper_options(const Options& given);

/// Reads the family ring_family(bits). A sighting has as its outline the circle of the outermost ring (an Ellipse
/// with equal axes), as its centre that circle's, and as its confidence the share of the K nearest training
/// profiles that have its code. Best first: more votes, then the nearer profile. Throws Error for a geometry that
/// is none.
std::unique_ptr<Detector> ring_paper_detector(const RingPaperOptions& options);

}  // namespace relock
