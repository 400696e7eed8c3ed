#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/catalogue.h"
#include "cli/runs/plan.h"
#include "cli/runs/record.h"
#include "core/schedule.h"
#include "eval/replay/multistart.h"
#include "sequences/open.h"

namespace relock {

/// What the runs of one table have in common.
struct Condition {
  std::size_t sequence;  ///< which of the matrix's
  std::string gaps;      ///< the pattern as it would be typed
  Protocol protocol = Protocol::once;
  std::uint64_t seed = 1;
  Gate gate = {};
  Schedule schedule;  ///< of the frames as they are played
  std::optional<RealTime> real_time = {};
  std::optional<Anchor> anchor = {};  ///< protocol multistart
};

/// One run that a plan asks for.
struct PlannedRun {
  std::size_t condition;  ///< which of the matrix's
  ChosenMethod method;
  std::vector<bool> asked;       ///< about which targets
  RunRecord record;              ///< its inputs
  std::filesystem::path folder;  ///< where its results belong
  bool there = false;            ///< the same run is there already
};

/// A plan, opened and multiplied out.
struct Matrix {
  std::vector<Sequence> sequences;
  std::vector<Condition> conditions;
  std::vector<PlannedRun> runs;       ///< condition by condition, yardsticks last in each
  std::vector<std::string> left_out;  ///< combinations that make no sense, and why

  const Condition& condition_of(const PlannedRun& run) const { return conditions[run.condition]; }
  const Sequence& sequence_of(const PlannedRun& run) const { return sequences[condition_of(run).sequence]; }
};

/// Opens the plan's sequences and makes a run of every combination that makes sense: a tracker has no start
/// in protocol detect, a reader of codes needs a target with one. Nothing is written. Throws Error when a
/// sequence cannot be opened or has nothing to score, when a method fits nowhere, and when results of
/// something else are in the way.
Matrix multiply_out(const Plan& plan, const Methods& methods);

/// What a run is played: frames in the order in which they are shown, and what is true of them.
struct Played {
  Recording recording;
  std::function<std::unique_ptr<FrameSource>()> frames;
  FrameIndex from = 0;  ///< nothing before it is shown
};
Played played(const Matrix& matrix, const PlannedRun& run);

/// Frames that a method is shown in a run.
std::size_t shown_frames(const Condition& condition);
/// Frames that the pattern took.
std::size_t dropped_frames(const Condition& condition);

}  // namespace relock
