#include <fmt/format.h>

#include "core/error.h"
#include "detectors/ring_marker.h"
#include "detectors/ring_paper.h"
#include "detectors/ring_paper/detector.h"

namespace relock {
namespace {

template <class Number>
OptionInfo number(const char* name, Number value, const char* unit, const char* sentence) {
  return {name, fmt::format("{}", value), unit, sentence};
}

}  // namespace

std::vector<OptionInfo> ring_paper_option_list() {
  const RingPaperOptions d;
  return {
      number("bits", d.bits, "", "of the codes that are read: ring2 for 2"),
      {"geometry", d.geometry, "",
       "where the rings are: paper, even, or their radii (0.18-0.33/0.41-0.55/…)"},
      {"inverted", d.inverted ? "true" : "false", "", "look for black rings on white"},
      number("wavelength_px", d.wavelength_px, "px", "lambda of the Gabor filters; 8 in the paper"),
      number("aspect", d.aspect, "", "gamma of the Gabor filters; 0.5 in the paper"),
      number("spread", d.spread, "wavelengths", "sigma of the Gabor filters; 0.56 in the paper"),
      number("threshold", d.threshold, "", "of the normalised response; 0.4 in the paper"),
      number("linkage_px", d.linkage_px, "px",
             "mean distance up to which components are one cluster; 150 in the paper"),
      number("neighbours", d.neighbours, "", "nearest training profiles that vote, K; 5 in the paper"),
      number("training_blur_px", d.training_blur_px, "px",
             "blur of the marker that is learned from; 40 in the paper"),
      number("training_marker_px", d.training_marker_px, "px",
             "diameter of the marker that is learned from: that of the paper's experiments"),
      number("kernel_px", d.kernel_px, "px",
             "side of the Gabor kernels, odd: 55 holds three sigma of the window's longer axis"),
      {"normalisation", "peak", "",
       "what is 1 to the threshold: the picture's peak, or an edge from black to white"},
      number("least_contrast", d.least_contrast, "grey levels",
             "step of an edge that can be the peak, so that noise is not amplified to it"),
      number("least_area_px", d.least_area_px, "px",
             "smallest component, in pixels: 126 is the filters' window, pi sigma^2 / gamma; smaller is "
             "noise or the tip of a weak response"),
      number("most_components", d.most_components, "",
             "components that are clustered, the largest ones: time grows with their square"),
      {"distance", "gaps", "",
       "of two components: of their centroids (centroids), the same with each counting as often as it has "
       "pixels (pixels), or of their boxes (gaps)"},
      number("scan_lines", d.scan_lines, "", "parallel lines that are averaged to the profile"),
      number("scan_spacing_px", d.scan_spacing_px, "px", "from line to line"),
      number("margin_px", d.margin_px, "px",
             "how far the profile goes on beyond the cluster's box: a ring and a gap of a marker of 150 px, "
             "whose arcs may be too small"),
      {"binarisation", "local", "",
       "where bright begins: local, halfway between neighbouring turning points, or middle, that of the "
       "range"},
      number("prominence", d.prominence, "",
             "swing between turning points that are told apart (local), parts of the profile's range"),
      number("width_tolerance", d.width_tolerance, "",
             "how much wider or narrower than the mean a bright stretch may be, parts of the mean"),
      number("samples", d.samples, "", "of the profiles that are compared"),
      {"compared", "all", "",
       "with which profiles: all, or those of codes of the counted number of rings (count)"},
      number(
          "farthest", d.farthest, "",
          "rms difference to the nearest training profile beyond which nothing is read, parts of the range"),
  };
}

RingPaperOptions ring_paper_options(const Options& given) {
  RingPaperOptions o;
  o.wavelength_px = given.number("wavelength_px", 2, 100);
  o.aspect = given.number("aspect", 0.1, 2);
  o.spread = given.number("spread", 0.1, 2);
  o.threshold = given.number("threshold", 0.01, 1);
  o.linkage_px = given.number("linkage_px", 0, 100000);
  o.neighbours = given.whole("neighbours", 1, 1000);
  o.training_blur_px = given.number("training_blur_px", 0, 500);
  o.training_marker_px = given.number("training_marker_px", 40, 500);
  o.bits = given.whole("bits", 1, kMostRingBits);
  o.geometry = given.word("geometry");
  o.inverted = given.flag("inverted");
  o.kernel_px = given.whole("kernel_px", 3, 255);
  if (o.kernel_px % 2 == 0)
    throw Error(
        fmt::format("ring-paper: option kernel_px is {}; it must be odd, to have a middle", o.kernel_px));
  o.normalisation =
      given.word("normalisation", {"peak", "edge"}) == "peak" ? Normalisation::peak : Normalisation::edge;
  o.least_contrast = given.number("least_contrast", 0.01, 255);
  o.least_area_px = given.whole("least_area_px", 1, 1000000);
  o.most_components = given.whole("most_components", 1, 10000);
  const std::string& distance = given.word("distance", {"centroids", "pixels", "gaps"});
  o.distance = distance == "centroids" ? ComponentDistance::centroids
               : distance == "pixels"  ? ComponentDistance::pixels
                                       : ComponentDistance::gaps;
  o.scan_lines = given.whole("scan_lines", 1, 25);
  o.scan_spacing_px = given.number("scan_spacing_px", 0, 20);
  o.margin_px = given.number("margin_px", 0, 1000);
  o.binarisation =
      given.word("binarisation", {"local", "middle"}) == "local" ? Binarisation::local : Binarisation::middle;
  o.prominence = given.number("prominence", 0.001, 1);
  o.width_tolerance = given.number("width_tolerance", 0, 100);
  o.samples = given.whole("samples", 8, 1000);
  o.compared = given.word("compared", {"all", "count"}) == "all" ? Compared::all : Compared::count;
  o.farthest = given.number("farthest", 0, 1);
  ring_geometry(o.geometry, o.bits);  // throws if it is none
  return o;
}

std::unique_ptr<Detector> ring_paper_detector(const RingPaperOptions& options) {
  return std::make_unique<ring_paper::RingPaperDetector>(options);
}

}  // namespace relock
