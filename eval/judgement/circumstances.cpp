#include "eval/judgement/circumstances.h"

#include <algorithm>

namespace relock {
namespace {

double border_distance(const Outline& outline, Size picture) {
  const Box box = bounds(outline), whole = picture_box(picture);
  return std::min(
      {box.x - whole.x, box.y - whole.y, whole.right() - box.right(), whole.bottom() - box.bottom()});
}

}  // namespace

Circumstances circumstances(const Recording& recording, const Trajectory& trajectory, std::size_t target,
                            const Loss& loss) {
  return circumstances(recording, trajectory, target, loss.first_lost);
}

Circumstances circumstances(const Recording& recording, const Trajectory& trajectory, std::size_t target,
                            FrameIndex arrival_frame) {
  const auto arrival = static_cast<std::size_t>(arrival_frame);
  std::size_t before = arrival - 1;
  Circumstances found;
  for (; before > 0 && trajectory.frames[before].delivery != Delivery::delivered; --before)
    ++(trajectory.frames[before].delivery == Delivery::dropped ? found.slots_injected : found.slots_skipped);
  for (std::size_t frame = before; frame < arrival; ++frame)
    found.slots_recorded +=
        slots(recording.captured[frame + 1] - recording.captured[frame], recording.period) - 1;
  found.slots = 1 + found.slots_recorded + found.slots_injected + found.slots_skipped;

  const TargetTruth& now = recording.truth_of(arrival, target);
  const TargetTruth& then = recording.truth_of(before, target);
  found.tilt_deg = now.tilt_deg;
  if (now.blur) found.blur_px = norm(*now.blur);
  if (!now.outline) return found;
  found.size_px = now.size_px();
  found.border_px = border_distance(*now.outline, recording.picture);
  if (then.outline)
    found.displacement_d =
        norm(now.centre(CentreKind::projected) - then.centre(CentreKind::projected)) / now.size_px();
  return found;
}

}  // namespace relock
