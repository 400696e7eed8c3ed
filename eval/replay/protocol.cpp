#include "eval/replay/protocol.h"

#include <fmt/format.h>

#include "core/error.h"

namespace relock {
namespace {

constexpr double kMostOcclusionAtStart = 0.1;

}  // namespace

std::string_view to_string(Protocol protocol) {
  constexpr std::string_view names[] = {"once", "reset", "vot", "multistart", "detect"};
  return names[static_cast<std::size_t>(protocol)];
}

Protocol parse_protocol(std::string_view text) {
  for (const Protocol protocol :
       {Protocol::once, Protocol::reset, Protocol::vot, Protocol::multistart, Protocol::detect})
    if (text == to_string(protocol)) return protocol;
  throw Error(
      fmt::format("no protocol is called \"{}\"; there are once, reset, vot, multistart and detect", text));
}

bool startable(const Recording& recording, std::size_t frame, std::size_t target) {
  const TargetTruth& truth = recording.truth_of(frame, target);
  if (truth.label != Label::visible || truth.occluded_fraction >= kMostOcclusionAtStart) return false;
  const Box box = bounds(*truth.outline), picture = picture_box(recording.picture);
  return box.x >= picture.x && box.y >= picture.y && box.right() <= picture.right() &&
         box.bottom() <= picture.bottom();
}

std::vector<std::optional<FrameIndex>> first_startable(const Recording& recording, FrameIndex from) {
  std::vector<std::optional<FrameIndex>> first(recording.targets.size());
  for (std::size_t t = 0; t < first.size(); ++t)
    for (auto frame = static_cast<std::size_t>(from); frame < recording.frames() && !first[t]; ++frame)
      if (startable(recording, frame, t)) first[t] = static_cast<FrameIndex>(frame);
  return first;
}

}  // namespace relock
