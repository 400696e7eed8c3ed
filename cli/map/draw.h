#pragma once

#include <string>

#include "cli/map/answer.h"
#include "cli/map/sweep.h"

namespace relock::maps {

/// The map as a picture for a paper, 180 mm wide: who leads where, with the boundary and its interval, above;
/// the locked share of every method below. The same map gives the same bytes.
std::string svg_of(const MeasuredMap& map, const Answer& answer);
/// The same at 200 dots per inch.
std::string png_of(const MeasuredMap& map, const Answer& answer);

}  // namespace relock::maps
