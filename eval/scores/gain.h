#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "eval/scores/paired.h"

namespace relock {

/// A tracker and what was made of it, each without and with a drop pattern, on one recording.
struct Family {
  const Recording& recording;
  std::vector<Pair> members;  ///< of this recording; the tracker alone is the first
};

/// One score of one member, and how much more it is than that of the tracker alone. An empty value is n/a.
struct Gained {
  std::optional<double> value;
  std::optional<double> gain;        ///< value - the tracker's alone; of losses less is better
  std::optional<Interval> interval;  ///< 95 %, of the gain; frames stay paired
};

/// What a member of the family gains, with gaps and without.
struct MemberGain {
  std::size_t losses_without = 0, losses_with = 0;
  std::array<Gained, kRatioScores> without, with;  ///< by CostScore
};

struct FamilyGain {
  std::size_t frames = 0;           ///< recorded, as far as they were compared
  std::size_t common_frames = 0;    ///< of them, delivered in all arms of all members
  std::size_t targets = 0;          ///< of all families' recordings
  std::size_t common_targets = 0;   ///< of them, all members were asked about
  std::vector<MemberGain> members;  ///< as they stand in the families; the tracker alone gains nothing
};

/// Compares the members of a family on the frames that are common to all their arms, up to the first reset in any
/// of them, and on the targets that all were asked about: so in one row of a table all values are of the
/// same. Every family has as many members. Families on recordings of one name are repetitions (seeds) of one
/// sequence, as for cost_of_gaps.
FamilyGain gain_of(std::span<const Family> families, const Gate& gate = {});

}  // namespace relock
