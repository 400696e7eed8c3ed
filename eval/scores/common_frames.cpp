#include "eval/scores/common_frames.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"

namespace relock {
namespace {

void check_fit(const Recording& recording, const Trajectory& arm) {
  if (arm.frames.size() == recording.frames() && arm.judged_from.size() == recording.targets.size()) return;
  throw Error(fmt::format("an arm of {} frames and {} targets is not of {}, which has {} and {}",
                          arm.frames.size(), arm.judged_from.size(), recording.name, recording.frames(),
                          recording.targets.size()));
}

/// A target is judged from the first frame on which it could have been given; in real time its start may come
/// later. So only what was given before can be given again.
std::size_t first_reset(const Trajectory& arm) {
  std::vector<bool> given_before(arm.judged_from.size());
  for (std::size_t frame = 0; frame < arm.frames.size(); ++frame) {
    for (const std::size_t target : arm.frames[frame].given) {
      if (given_before[target]) return frame;
      given_before[target] = true;
    }
  }
  return arm.frames.size();
}

std::vector<bool> delivered_in_both(const Trajectory& a, const Trajectory& b, std::size_t frames) {
  std::vector<bool> common(frames);
  for (std::size_t frame = 0; frame < frames; ++frame)
    common[frame] =
        a.frames[frame].delivery == Delivery::delivered && b.frames[frame].delivery == Delivery::delivered;
  return common;
}

/// T by the rule for recordings that state no rate; the recording's own where two frames are not there to tell.
Duration period_of_common(const Recording& recording, const std::vector<bool>& common) {
  std::vector<Time> captured;
  for (std::size_t frame = 0; frame < common.size(); ++frame)
    if (common[frame]) captured.push_back(recording.captured[frame]);
  return captured.size() < 2 ? recording.period : nominal_period(captured);
}

}  // namespace

std::size_t frames_before_reset(const Trajectory& without, const Trajectory& with) {
  return std::min(first_reset(without), first_reset(with));
}

Trajectory up_to(Trajectory trajectory, std::size_t frames) {
  trajectory.frames.resize(frames);
  return trajectory;
}

Trajectory only(const Trajectory& arm, const std::vector<bool>& delivered) {
  Trajectory kept = up_to(arm, delivered.size());
  for (std::size_t frame = 0; frame < delivered.size(); ++frame)
    if (!delivered[frame]) kept.frames[frame] = {.delivery = Delivery::dropped};
  return kept;
}

CommonFrames common_frames(const Recording& recording, const Trajectory& without, const Trajectory& with) {
  check_fit(recording, without);
  check_fit(recording, with);
  CommonFrames both;
  const std::size_t comparable = frames_before_reset(without, with);
  both.ends_at_reset = comparable < recording.frames();
  both.common = delivered_in_both(without, with, comparable);
  while (!both.common.empty() && !both.common.back())
    both.common.pop_back();  // no time after the last of them
  both.recording = up_to(recording, both.common.size());
  both.recording.period = period_of_common(recording, both.common);
  both.without = only(without, both.common);
  both.with = only(with, both.common);
  return both;
}

}  // namespace relock
