#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "eval/judgement/circumstances.h"

namespace relock {

// A loss in words. Times are seconds from the first recorded frame.

/// "lost silently at 0.90-1.00 s, over a gap of 3 slots": how and when. `gap_note` is put after the slots.
std::string onset_text(const Recording& recording, const Loss& loss, const Circumstances& circumstances,
                       std::string_view gap_note = "");

/// "recovered in 0.37 s", "not recovered in the 0.83 s before the target left".
std::string end_text(const Recording& recording, const Loss& loss);

/// Whose slots a gap is made of: " (1 recorded, 2 injected)"; empty without a gap.
std::string gap_note(const Circumstances& circumstances);

/// The target on the first frame of the loss, as far as it is known: "46 px large, blurred over 12.3 px, 0.35 D
/// from where it was before, 45 px from the border, tilted by 20 degrees".
std::string arrival_text(const Circumstances& circumstances);

/// What was said while lost, isolated Hits aside: "a wrong place on 14 frames and nothing on 3".
std::string said_text(const Loss& loss);

/// "a, b and c".
std::string joined(const std::vector<std::string>& words);

}  // namespace relock
