#pragma once

#include <span>
#include <vector>

#include "eval/judgement/evaluation.h"
#include "eval/judgement/visible_time.h"

namespace relock {

/// What one recorded frame adds to the scores that are shares of a whole (metrics.md section 6): counts of that
/// frame, and what was done with the visible time from it to the next labelled frame. Added up over frames,
/// targets and recordings they give the scores; kept apart, frame by frame, their intervals.
struct Contribution {
  std::int64_t could_hit = 0;  ///< recognition's denominator: visible, not NotStarted, Given or Dropped
  std::int64_t hits = 0;
  std::int64_t said = 0;       ///< sightings that were judged: precision's denominator
  Duration visible{0};         ///< visible time = locked + lost + searching
  Duration fresh{0};           ///< of it, with a Hit at most 0.1 s old
  Duration fresh_ceiling{0};   ///< … had every frame that could have one a Hit
  Duration locked{0};          ///< of it, Locked
  Duration locked_ceiling{0};  ///< … had every frame that could have one a Hit
  Duration lost{0};            ///< of it, Lost

  Contribution& operator+=(const Contribution& other);
  friend bool operator==(const Contribution&, const Contribution&) = default;
};

/// Of one target, one for each recorded frame. `visible`: its visible_time. `said` counts what its own verdicts
/// rest on.
std::vector<Contribution> contributions(const Recording& recording, const Evaluation& evaluation,
                                        std::size_t target, std::span<const VisibleInterval> visible);
std::vector<Contribution> contributions(const Recording& recording, const Evaluation& evaluation,
                                        std::size_t target);

/// Adds each frame's spurious sightings: they belong to no target, only to all of them together.
void add_spurious(std::vector<Contribution>& frames, const Evaluation& evaluation);

}  // namespace relock
