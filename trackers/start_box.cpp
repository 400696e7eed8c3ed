#include "trackers/start_box.h"

#include <fmt/format.h>

#include "core/error.h"
#include "core/opencv.h"

namespace relock {
namespace {

constexpr int kLeastSidePx = 10;
constexpr double kLeastShareInside = 0.5;

}  // namespace

cv::Rect whole_pixels(const Box& box, Size picture) {
  // Left edge and width round on their own, so that a box within the picture may round to one beyond it.
  return rounded_rect(box) & cv::Rect(0, 0, picture.width, picture.height);
}

Box startable_box(std::string_view tracker, const Image& picture, const Box& box) {
  if (picture.empty()) throw Error(fmt::format("{} was given an empty picture to start on", tracker));
  const Size size = picture.size();
  const auto refuse = [&](std::string_view why) {
    throw Error(fmt::format(
        "{} cannot start on the box x {:g}, y {:g}, {:g} x {:g} px in a picture of {} x {} px: {}", tracker,
        box.x, box.y, box.width, box.height, size.width, size.height, why));
  };
  if (!well_formed(box)) refuse("its numbers must be finite and its sides above zero");
  const Box whole = picture_box(size);
  if (share_inside(box, whole) < kLeastShareInside) refuse("at least half of it must lie in the picture");
  const Box seen = intersect(box, whole);
  const cv::Rect pixels = whole_pixels(seen, size);
  if (pixels.width < kLeastSidePx || pixels.height < kLeastSidePx)
    refuse(fmt::format("the part in the picture must be at least {0} x {0} px", kLeastSidePx));
  if (pixels.width == size.width && pixels.height == size.height) refuse("it must not be the whole picture");
  return seen;
}

}  // namespace relock
