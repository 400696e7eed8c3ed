#pragma once

#include <string>

#include "eval/judgement/evaluation.h"

namespace relock {

/// "lost at 0.20 s": "Lost at 0.20 s."; nothing of nothing.
std::string as_sentence(std::string text);

/// A loss in whole sentences, as `relock explain` and the report tell it. Empty where there is nothing to tell.
struct LossSentences {
  std::string
      what;  ///< "Lost silently at 0.90-1.00 s, over a gap of 3 slots (3 injected); recovered in 0.37 s."
  std::string target;  ///< "The target was 45 px large, 0.50 D from where it was before."
  std::string said;    ///< "While lost, it said nothing on 3 frames."
};
LossSentences sentences_of(const Recording& recording, const Trajectory& trajectory, std::size_t target,
                           const Loss& loss);

}  // namespace relock
