#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/detector.h"
#include "core/options.h"
#include "detectors/marker_cells.h"

namespace relock {

/// Square AprilTags (Wang and Olson 2016, Krogius et al. 2019), found and read by libapriltag.
struct ApriltagOptions {
  std::string family =
      "tag36h11";          ///< tag36h11, tag36h10, tag25h9, tag16h5, tagStandard41h12 or tagCircle21h7
  double decimate = 1;     ///< tags are looked for in a picture this many times smaller
  double sigma_px = 0;     ///< Gaussian blur before looking; below 0 sharpens
  int threads = 1;         ///< of the library
  int hamming = 1;         ///< wrong bits that are corrected, at most 2
  double min_margin = 10;  ///< smallest decision margin believed, grey levels
};

/// The options as `relock list --verbose` prints them, with the defaults of ApriltagOptions.
std::vector<OptionInfo> apriltag_option_list();
/// Throws Error naming the option, the value and the legal range.
ApriltagOptions apriltag_options(const Options& given);
/// Family of the codes it reads: "apriltag36h11" for tag36h11.
std::string apriltag_family(const ApriltagOptions& options);

/// A sighting has the projected centre (where the diagonals meet) and a Quad: the border whose side AprilTag
/// calls the tag's size. For families that carry bits outside of the border (tagStandard…, tagCircle…) the
/// print is larger than that. Its confidence is the decision margin (how far the average bit is from the
/// black-white threshold) divided by 127.5, which black on white has when sharp, and cut at 1. Best
/// confidence first.
std::unique_ptr<Detector> apriltag_detector(const ApriltagOptions& options);

/// The families it knows: "tag36h11", "tag25h9" …
std::vector<std::string> apriltag_families();
/// The print of tag `id`. Throws Error if the family has no such tag.
MarkerCells apriltag_cells(const std::string& family, int id);

}  // namespace relock
