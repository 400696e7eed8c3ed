#include "eval/replay/multistart.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "eval/replay/protocol.h"

namespace relock {
namespace {

bool any_startable(const Recording& recording, FrameIndex frame) {
  for (std::size_t t = 0; t < recording.targets.size(); ++t)
    if (startable(recording, static_cast<std::size_t>(frame), t)) return true;
  return false;
}

}  // namespace

std::string_view to_string(Direction direction) {
  return direction == Direction::forward ? "forward" : "backward";
}

Direction parse_direction(std::string_view text) {
  for (const Direction direction : {Direction::forward, Direction::backward})
    if (text == to_string(direction)) return direction;
  throw Error(fmt::format("no direction is called \"{}\"; there are forward and backward", text));
}

std::string to_string(const Anchor& anchor) {
  return fmt::format("frame {} {}", anchor.frame, to_string(anchor.direction));
}

std::vector<Anchor> anchors(const Recording& recording, const MultistartOptions& options) {
  const auto frames = static_cast<FrameIndex>(recording.frames());
  std::vector<Anchor> all;
  FrameIndex last = -1;
  for (FrameIndex nominal = 0; nominal < frames; nominal += options.every) {
    FrameIndex frame = nominal;
    while (frame < frames && !any_startable(recording, frame)) ++frame;
    if (frame == frames) break;
    if (frame == last) continue;
    last = frame;
    for (const Direction direction : {Direction::forward, Direction::backward}) {
      const Anchor anchor{frame, direction};
      if (frames - start_of(anchor, recording.frames()) >= options.fewest) all.push_back(anchor);
    }
  }
  return all;
}

FrameIndex start_of(const Anchor& anchor, std::size_t frames) {
  return anchor.direction == Direction::forward ? anchor.frame
                                                : static_cast<FrameIndex>(frames) - 1 - anchor.frame;
}

Recording reflected(const Recording& recording) {
  Recording turned = recording;
  turned.captured = reflected(recording.captured);
  const std::size_t frames = recording.frames();
  for (std::size_t frame = 0; frame < frames; ++frame) {
    for (std::size_t t = 0; t < recording.targets.size(); ++t) {
      TargetTruth& truth = turned.truth_of(frame, t);
      truth = recording.truth_of(frames - 1 - frame, t);
      if (truth.blur) truth.blur = Vec2{} - *truth.blur;
    }
  }
  return turned;
}

Schedule reflected(const Schedule& schedule) {
  Schedule turned(schedule.frames());
  for (std::size_t frame = 0; frame < schedule.frames(); ++frame)
    if (!schedule.delivered(frame)) turned.drop(schedule.frames() - 1 - frame);
  return turned;
}

}  // namespace relock
