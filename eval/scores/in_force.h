#pragma once

#include <optional>
#include <span>
#include <vector>

#include "eval/judgement/evaluation.h"
#include "eval/replay/real_time.h"

namespace relock {

/// The answers that a controller has, frame by frame (metrics.md section 7): at recorded frame k the last answer, of
/// frames up to k, that is finished by the arrival of frame k+1 (at the last frame: one period later).
///
/// A controller goes on when a frame is missed or lost: every recorded frame has an answer in force, so that here none
/// is Skipped or Dropped. A start is no answer: from when it is finished, nothing is said of its target until the next
/// frame is answered. Frames on which a box was handed over are Given here, too.
struct InForce {
  Trajectory trajectory;  ///< judged against the truth of the frame it is in force at
  std::vector<std::optional<FrameIndex>>
      answers;  ///< at each recorded frame, the frame whose answer is in force
  std::vector<double>
      answer_age_s;  ///< at each, captured since that frame; infinite where there is no answer
};
/// `answers` in order, as replay gives them.
InForce in_force(const Recording& recording, const Trajectory& trajectory, std::span<const Answer> answers);

/// Why the answer in force on a visible frame is no Hit.
enum class LostTo : std::uint8_t {
  slowness,  ///< it was right on its own frame, or is not there yet; a newer frame has been delivered since
  gaps,      ///< likewise, and nothing newer has been delivered: the fastest method would have had no more
  failure,   ///< it was wrong on its own frame already, or the method has crashed
};
constexpr std::size_t kLostTo = 3;

/// What one target, or several together, looked like in real time. Counts are of frames.
struct RealTimeScores {
  std::size_t own = 0;       ///< visible, and not NotStarted, Given or Dropped on the method's own frames …
  std::size_t own_hits = 0;  ///< … of these, Hits
  std::size_t skipped = 0;   ///< of all delivered and judged frames, visible or not …
  std::size_t delivered = 0;
  std::size_t in_force = 0;               ///< visible, and neither NotStarted nor Given …
  std::size_t hits = 0;                   ///< … of these, Hits …
  std::size_t lost[kLostTo] = {};         ///< … and all others: they add up to `in_force`
  std::vector<double> answer_age_s = {};  ///< on each of these frames; infinite where there is no answer

  RealTimeScores& operator+=(const RealTimeScores& other);
};

/// For each target. An answer that says nothing of a target that was absent, or a target that was Given, counts as
/// right on its own frame; one of a frame without a label does not.
std::vector<RealTimeScores> score_real_time(const Recording& recording, const Trajectory& trajectory,
                                            std::span<const Answer> answers, const Gate& gate = {});

}  // namespace relock
