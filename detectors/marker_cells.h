#pragma once

#include <cstdint>
#include <vector>

namespace relock {

/// A printed marker as its squares: what a printer or a simulator needs to show it.
struct MarkerCells {
  int side = 0;    ///< squares along one side of the whole print, white margin included
  int margin = 0;  ///< squares between the edge of the print and the outline that the detector reports
  std::vector<std::uint8_t> grey;  ///< side * side values, row by row from the top: 0 black, 255 white
};

}  // namespace relock
