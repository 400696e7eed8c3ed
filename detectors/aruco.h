#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/detector.h"
#include "core/options.h"
#include "detectors/marker_cells.h"

namespace relock {

/// Square ArUco markers (Garrido-Jurado et al. 2014), found and read by OpenCV.
struct ArucoOptions {
  std::string dictionary = "6x6_250";        ///< 4x4_50 … 7x7_1000, or original
  std::string corner_refinement = "subpix";  ///< none, subpix or contour
  double min_side_px = 10;                   ///< smallest marker looked for
  double error_correction = 0.6;             ///< part of the dictionary's correctable bits that is corrected
  double threshold_constant = 7;  ///< how far below its neighbourhood's mean a pixel is called black
};

/// The options as `relock list --verbose` prints them, with the defaults of ArucoOptions.
std::vector<OptionInfo> aruco_option_list();
/// Throws Error naming the option, the value and the legal range.
ArucoOptions aruco_options(const Options& given);
/// Family of the codes it reads: "aruco6x6_250" for the dictionary 6x6_250.
std::string aruco_family(const ArucoOptions& options);

/// A sighting has the projected centre (where the diagonals meet), the outer edge of the black border as a
/// Quad, and confidence 1, because the library gives no score. Larger markers come first.
std::unique_ptr<Detector> aruco_detector(const ArucoOptions& options);

/// The dictionaries it knows: "4x4_50" … "7x7_1000", "original".
std::vector<std::string> aruco_dictionaries();
/// The print of marker `id`. Throws Error if the dictionary has no such marker.
MarkerCells aruco_cells(const std::string& dictionary, int id);

}  // namespace relock
