#pragma once

#include <optional>
#include <vector>

#include "core/recording.h"
#include "eval/trajectory.h"

// The rules of the supervised VOT experiments of 2013 to 2019 (protocol vot, metrics.md section 5; Kristan et al., "A
// novel performance evaluation methodology for single-target trackers", TPAMI 2016). A tracker whose answer does not
// overlap the target has failed; it is started again five frames after that.

namespace relock {

/// Frames from a failure to the start after it: VOT's skip_initialize.
inline constexpr FrameIndex kVotSkip = 5;

/// Whether a report leaves a visible target alone: nothing that is said of it overlaps its outline inside the picture.
/// Said of it is what carries its id, and what carries none.
bool misses_by_vot(const Recording& recording, std::size_t frame, std::size_t target,
                   const FrameReport& report);

/// What a frame is to VOT. In brackets, the special codes of its result files.
enum class VotFrame : std::uint8_t {
  outside,   ///< [0] before the first start, after a failure until the next start, or after a crash
  start,     ///< [1] the box was handed over
  failure,   ///< [2] no overlap
  tracked,   ///< a region is there, and overlaps
  unjudged,  ///< between start and failure, but dropped, or not visible: VOT has no such frames
};

/// For every recorded frame of a run by protocol vot. Accuracy is the mean overlap over `tracked` frames, those within
/// the burn-in after a start left out; robustness counts `failure` frames. After a crash the first visible frame is
/// the last failure, since nobody answers there.
std::vector<VotFrame> vot_frames(const Recording& recording, const Trajectory& trajectory,
                                 std::size_t target);

}  // namespace relock
