#pragma once

#include <memory>
#include <vector>

#include "core/options.h"
#include "core/tracker.h"

namespace relock {

// Yardsticks say how hard a recording is: a tracker that does not beat them has shown nothing. They are
// deterministic, take any box that touches the picture, and throw for no picture but an empty one.

/// Says the start box for ever.
std::unique_ptr<Tracker> still_tracker();

struct LinearOptions {
  int frames = 5;  ///< delivered frames after the start from which the velocity is measured
};
std::vector<OptionInfo> linear_option_list();
/// Throws Error naming the option, the value and the legal range.
LinearOptions linear_options(const Options& given);

/// Moves the start box at a constant velocity for ever.
///
/// It sees no truth after the start, so it measures the velocity itself: in each of the first `frames`
/// delivered frames it finds the start patch (grey, normalised cross-correlation of at least 0.5, one box
/// size around where the velocity so far leads, at least 16 px, to a part of a pixel). The velocity is the
/// least-squares slope of these places over capture time through the start, and zero as long as nothing was
/// found. After these frames it looks at no picture any more. Once the box has left the picture, it says
/// nothing.
std::unique_ptr<Tracker> linear_tracker(const LinearOptions& options);

}  // namespace relock
