#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/recording.h"
#include "eval/trajectory.h"

namespace relock {

// What the toolkits of VOT, OTB, GOT-10k and evo see of a run: one target, one outline in each frame. Their
// scores (got10k.h, otb.h, vot.h, ape.h in this folder) follow their own conventions, which differ from each
// other and from docs/metrics.md; docs/compatibility.md compares them.

/// One frame of one target.
struct AnsweredFrame {
  std::optional<Outline> truth;   ///< nothing: absent, or its place is not known
  double visible_fraction = 1.0;  ///< as TargetTruth has it
  bool given = false;             ///< the method was handed the true box here
  std::optional<Outline> answer;  ///< what the method said; nothing where it said nothing
  bool judged = true;             ///< delivered, and the target is labelled visible
};

/// What a method said of one target from the start frame on. The first frame is the one on which its
/// tracker is handed the box; for a method that is handed none, the one on which the others are.
struct AnsweredSequence {
  std::string name;  ///< the recording's; with several targets RECORDING-TARGET
  Size picture;      ///< px
  std::size_t first_frame = 0;
  std::vector<AnsweredFrame> frames;
};

/// The first sighting that follows the target, else the first that read its code, else (one target only) the
/// first of all.
std::optional<Outline> answer_for(const Recording& recording, const FrameReport& report, std::size_t target);

/// "klahaag", or "Jogging-1" where the recording has several targets; safe as a file's name.
std::string sequence_name(const Recording& recording, std::size_t target);

/// Nothing when the method was not asked about the target.
std::optional<AnsweredSequence> answers_for(const Recording& recording, const Trajectory& trajectory,
                                            std::size_t target);

}  // namespace relock
