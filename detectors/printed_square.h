#pragma once

#include <string>
#include <vector>

#include "core/sighting.h"
#include "detectors/marker_cells.h"

namespace relock {

/// Families of codes that are printed as squares, as the detectors name them: "aruco6x6_250",
/// "apriltag36h11".
std::vector<std::string> square_marker_families();

/// The print of a code of one of these families, with at least one white cell all around. Its outline (what
/// `margin` leads to) is the square that the detector reports. Throws Error for a family that is none and for
/// a value that is no number of one of its markers.
MarkerCells square_marker_cells(const Code& code);

}  // namespace relock
