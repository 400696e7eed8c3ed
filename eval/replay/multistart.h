#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/recording.h"
#include "core/schedule.h"

// Protocol multistart (metrics.md section 5): a recording is played many times, from anchors spread over it, forward
// and backward. One start says little: where it falls decides much. Every anchor and direction is a run of its own.

namespace relock {

enum class Direction : std::uint8_t {
  forward,   ///< as recorded
  backward,  ///< time reflected: the last frame first
};
std::string_view to_string(Direction direction);
/// Throws Error when `text` is neither.
Direction parse_direction(std::string_view text);

/// Where a run of protocol multistart begins, and which way it goes.
struct Anchor {
  FrameIndex frame = 0;  ///< counted as recorded, whichever way is gone
  Direction direction = Direction::forward;
  friend auto operator<=>(const Anchor&, const Anchor&) = default;
};
/// "frame 50 backward".
std::string to_string(const Anchor& anchor);

struct MultistartOptions {
  FrameIndex every = 50;   ///< frames from one anchor to the next, the first on frame 0
  FrameIndex fewest = 25;  ///< a run with fewer frames than this, the anchor's included, is left out
};

/// The runs of a recording, in order of frames. An anchor on which no target can be started moves on to the next
/// frame, as recorded, on which one can; where there is none, and where it meets another anchor, it is left out.
std::vector<Anchor> anchors(const Recording& recording, const MultistartOptions& options = {});

/// The anchor's place in its run's own frames: those before it are not played.
FrameIndex start_of(const Anchor& anchor, std::size_t frames);

/// The recording as it is played backward: frames in reversed order, captured at first + (last - time), so that
/// every interval keeps its length; blur points the other way, because start and end of an exposure change places.
/// Reflected twice it is what it was.
Recording reflected(const Recording& recording);
/// Likewise: which frames are delivered.
Schedule reflected(const Schedule& schedule);

}  // namespace relock
