#pragma once

#include <cstddef>
#include <vector>

#include "core/recording.h"

// Single jumps: a tracker is started, holds its target for some frames, then frames go missing and the target is
// elsewhere. How far may that be? A loss at a gap says how far a method searches, and this is the curve of it.

namespace relock::jumps {

/// One jump: started on a frame, shown `before` more (0: the gap follows the start at once), `missing` not shown,
/// `after` shown, and judged on the last.
struct JumpTest {
  int before = 8, after = 5;
  int most_missing = 14;
  /// Displacements over the gap are told apart by these, in parts of the target's size D; 0 first, increasing. What
  /// goes farther than the last is left out.
  std::vector<double> edges{0, 0.25, 0.5, 0.75, 1, 1.5, 2};

  int window() const { return 1 + before + most_missing + after; }
  std::size_t bins() const { return edges.size() - 1; }
};

/// A gap in a window of frames, by which the target jumps.
struct Jump {
  std::size_t target = 0;
  FrameIndex start = 0;  ///< the frame on which the box is handed over
  int missing = 0;       ///< frames
  double distance = 0;   ///< of the target's centres on the last frame before and the first after, in D
  std::size_t bin = 0;   ///< which of the test's
};

/// The jumps of a recording. Windows follow one another without a common frame, so that the jumps of a bin are
/// independent but for being of one recording; each window has at most one for a target and bin, the one nearest to the
/// bin's middle. The target is startable at the start, and visible on every frame that is judged.
std::vector<Jump> jumps_in(const Recording& recording, const JumpTest& test);

/// What time it is after a gap.
enum class Clock : std::uint8_t {
  kept,    ///< as recorded: the missing frames took their time
  closed,  ///< as if no frame were missing: the same jump, without a gap in time
};

/// The frames that a jump is about, and what is true of its target in them.
struct Scene {
  Recording recording;               ///< of one target
  std::vector<std::size_t> frames;   ///< which frames of the whole recording they are
  std::vector<std::size_t> missing;  ///< which of `frames` are not shown
  std::size_t held = 0;              ///< of `frames`: the last before the gap
  std::size_t judged = 0;            ///< and the last of all
};
Scene scene_of(const Recording& recording, const Jump& jump, const JumpTest& test, Clock clock);

}  // namespace relock::jumps
