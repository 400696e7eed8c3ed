#include "trackers/start_box.h"

#include <fmt/format.h>

#include <cmath>

#include "core/error.h"

namespace relock {
namespace {

constexpr double kLeastSidePx = 10;
constexpr double kLeastShareInside = 0.5;

/// Rounds the edges' middle and the sides, each to the nearest whole pixel.
Box rounded(const Box& box) {
  return {std::round(box.x + 0.5) - 0.5, std::round(box.y + 0.5) - 0.5, std::round(box.width),
          std::round(box.height)};
}

}  // namespace

Box startable_box(std::string_view tracker, const Image& picture, const Box& box) {
  if (picture.empty()) throw Error(fmt::format("{} was given an empty picture to start on", tracker));
  const auto refuse = [&](std::string_view why) {
    throw Error(fmt::format(
        "{} cannot start on the box x {:g}, y {:g}, {:g} x {:g} px in a picture of {} x {} px: {}", tracker,
        box.x, box.y, box.width, box.height, picture.size().width, picture.size().height, why));
  };
  if (!well_formed(box)) refuse("its numbers must be finite and its sides above zero");
  const Box whole = picture_box(picture.size());
  const Box seen = rounded(intersect(box, whole));
  if (share_inside(box, whole) < kLeastShareInside) refuse("at least half of it must lie in the picture");
  if (seen.width < kLeastSidePx || seen.height < kLeastSidePx)
    refuse(fmt::format("the part in the picture must be at least {0:g} x {0:g} px", kLeastSidePx));
  if (seen == whole) refuse("it must not be the whole picture");
  return seen;
}

}  // namespace relock
