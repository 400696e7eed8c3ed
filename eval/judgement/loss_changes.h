#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "core/recording.h"
#include "eval/judgement/states.h"

namespace relock {

/// What became of a loss between two runs on the same recording.
enum class LossFate : std::uint8_t {
  kept,     ///< both runs lost the target in the same place: between the same two frames
  moved,    ///< the same episode, and it begins between two other frames
  gone,     ///< only the first run has it
  appeared  ///< only the second run has it
};
/// "kept", "moved", "gone", "new".
std::string_view to_string(LossFate fate);

/// One episode of loss, in one run or in both.
struct LossChange {
  LossFate fate = LossFate::kept;
  std::optional<Loss> before, after;
  /// Of an episode in both: how much later it begins (early end of the onset) and how much longer it lasts.
  Duration later{0}, longer{0};

  /// Kept, and yet not the same: of another length, kind or end.
  bool differs() const;
};

/// Onsets so far apart may still be of one episode.
constexpr Duration kSameEpisodeWithin{500'000'000};

/// Which losses of `before` and `after` are the same episodes, in order of time.
///
/// A loss lasts from the early end of its onset, the last frame that held, to its end. Two losses may be one episode
/// when they share time, or when their onsets lie at most kSameEpisodeWithin apart. Each is paired with one other at
/// most: those whose onsets are closest first, then the earlier. Both lists are in order of time, of one target.
std::vector<LossChange> loss_changes(const Recording& recording, const std::vector<Loss>& before,
                                     const std::vector<Loss>& after);

}  // namespace relock
