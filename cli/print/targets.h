#pragma once

#include <string_view>

#include "core/printed_target.h"

namespace relock {

/// The target that `relock marker` prints under this name (cli/print/design.h), as a picture: the
/// TargetResolver of the simulator.
///
///     ring:01, ring(geometry=even):010   circle, size_m is the diameter of the outermost ring
///     ring:01-red                        on a coloured sheet, as it is seen in grey
///     disc                               the same, a white disc on black, without a code
///     aruco6x6_250:23, apriltag36h11:5   square, size_m is the side that the detectors report
///
/// The picture is about 1024 px wide. Each pixel has the mean light over its area, black 0 and white 255, and
/// is the same on every machine. Throws Error for a name that is none.
PrintedTarget print_target(std::string_view name, double size_m);

}  // namespace relock
