#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/recording.h"

namespace relock {

/// One picture of a video of a recording, and when it is shown.
struct Shot {
  Time shown;
  std::optional<std::size_t> frame;  ///< the last recorded frame that came; nothing before the first
  bool frozen = false;               ///< no frame comes here: it stands since `frame`
};

/// Every frame that came is shown at its capture time. Where none comes, because it was dropped on the way or never
/// recorded, the last one stands and is shown again at every slot, so that it can say for how long. A gap has at most
/// 600 such pictures. `came`: of each recorded frame. Only what lies within [from, to].
std::vector<Shot> shots_of(const Recording& recording, const std::vector<bool>& came, Time from, Time to);

}  // namespace relock
