#pragma once

#include <string>

#include "eval/judgement/evaluation.h"

namespace relock {

/// How timelines are drawn in text.
struct TimelineStyle {
  int columns = 60;      ///< widest lane
  bool unicode = false;  ///< blocks instead of letters
  bool colour = false;   ///< ANSI colours
};

/// One target's verdicts as a lane, true to time: a character for each slot of the recording, gaps included,
/// or for several slots where the recording is longer than the lane (then the verdict that most of them have,
/// the worse one of equals; Given always shows).
std::string lane(const Recording& recording, const TargetTimeline& timeline, const TimelineStyle& style);

/// A ruler for lanes: marks at round times, labelled in seconds.
std::string ruler(const Recording& recording, const TimelineStyle& style);

/// What each character of a lane means, in one line.
std::string legend(const TimelineStyle& style);

/// What became of one target, in a sentence: "lost silently at 4.13-4.27 s, over a gap of 4 slots; not
/// recovered in 9.20 s".
std::string story(const Recording& recording, const Trajectory& trajectory, const Evaluation& evaluation,
                  std::size_t target);

}  // namespace relock
