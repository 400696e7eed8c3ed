#pragma once

#include <cstdint>
#include <functional>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "core/sighting.h"

namespace relock {

/// Form of a target's outline on its sheet; in the middle of the sheet, upright.
enum class PrintedOutline : std::uint8_t {
  circle,  ///< size_m is the diameter
  square,  ///< size_m is the side
};

/// A target as it comes out of the printer: what the simulator hangs into its scene.
struct PrintedTarget {
  std::string name;               ///< as it is asked for: "ring:01", "aruco6x6_250:23"
  std::optional<Code> code = {};  ///< what a reader of codes should read on it
  PrintedOutline outline = PrintedOutline::square;
  double size_m = 0.15;  ///< of the outline
  double sheet_m = 0.2;  ///< side of the square sheet, quiet zone and border and all
  /// The whole square sheet from its top left corner, CV_8UC1, square, in display (sRGB) coding; smooth enough
  /// that bilinear sampling at full size shows no steps.
  cv::Mat picture = {};
};

/// Makes the target of a name at a size (side or diameter, metres). Throws Error for a name that is none.
using TargetResolver = std::function<PrintedTarget(std::string_view name, double size_m)>;

}  // namespace relock
