#include "cli/video/shots.h"

#include <algorithm>

namespace relock {
namespace {

constexpr std::int64_t kMostInAGap = 600;

/// Between two recorded frames of which the second follows after a gap.
void add_frozen(std::vector<Shot>& shots, std::optional<std::size_t> frame, Time last, Time next,
                Duration period) {
  const Duration step = std::max(period, (next - last) / kMostInAGap);
  for (Time at = last + step; at + step / 2 < next; at += step) shots.push_back({at, frame, true});
}

}  // namespace

std::vector<Shot> shots_of(const Recording& recording, const std::vector<bool>& came, Time from, Time to) {
  std::vector<Shot> shots;
  std::optional<std::size_t> last;
  for (std::size_t frame = 0; frame < recording.frames(); ++frame) {
    const Time now = recording.captured[frame];
    if (frame > 0) add_frozen(shots, last, recording.captured[frame - 1], now, recording.period);
    if (came[frame]) last = frame;
    shots.push_back({now, last, !came[frame]});
  }
  std::erase_if(shots, [&](const Shot& shot) { return shot.shown < from || shot.shown > to; });
  return shots;
}

}  // namespace relock
