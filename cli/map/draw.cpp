#include "cli/map/draw.h"
namespace relock::maps {
std::string svg_of(const MeasuredMap&, const Answer&) { return ""; }
std::string png_of(const MeasuredMap&, const Answer&) { return ""; }
}  // namespace relock::maps
