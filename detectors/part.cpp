#include "detectors/part.h"

#include <algorithm>
#include <cmath>

namespace relock {
namespace {

// The widest threshold window of ArUco reaches 12 px; a quarter of the box covers a marker's white margin.
constexpr double kMarginPx = 16;
constexpr double kMarginShare = 0.25;

}  // namespace

Part part_to_search(const Image& picture, const std::optional<Box>& where) {
  if (picture.empty() || !where || !well_formed(*where)) return {picture, {}};
  const double margin = kMarginPx + kMarginShare * std::max(where->width, where->height);
  const Box wide{where->x - margin, where->y - margin, where->width + 2 * margin, where->height + 2 * margin};
  // Clipped while still double: a hint may be too large for an int.
  const Box inside = intersect(wide, picture_box(picture.size()));
  const int left = static_cast<int>(std::floor(inside.x + 0.5)),
            top = static_cast<int>(std::floor(inside.y + 0.5));
  const Size size{static_cast<int>(std::ceil(inside.right() + 0.5)) - left,
                  static_cast<int>(std::ceil(inside.bottom() + 0.5)) - top};
  if (inside.area() <= 0) return {};
  const auto* first = picture.row(top) + left * channels(picture.format());
  return {Image(first, size, picture.format(), picture.stride()),
          {static_cast<double>(left), static_cast<double>(top)}};
}

}  // namespace relock
