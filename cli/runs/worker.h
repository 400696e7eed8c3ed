#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/runs/child.h"
#include "cli/runs/folder.h"
#include "cli/runs/matrix.h"

namespace relock {

/// One run in a process of its own. The worker replays and tells every answer at once; what it told is
/// complete when it crashes, and its run is scored as failed from there on.
class Worker {
 public:
  /// Both must outlive the worker. Throws Error when the system gives no process.
  Worker(const Matrix& matrix, const PlannedRun& run, const RunLimits& limits);

  const Child& child() const { return child_; }
  const PlannedRun& run() const { return run_; }
  /// Recorded frames that it is done with.
  std::size_t frames_done() const { return frames_done_; }

  /// Hears what it has told meanwhile. The finished run once it has ended, by itself or not. Throws Error
  /// when it could not be made ready: a recording that cannot be opened is no fault of the method.
  std::optional<FinishedRun> look();

 private:
  void hear(const std::string& message);
  FinishedRun finished(const ChildEnd& end);
  void complete_failed(FinishedRun& done, const Failure& failure);

  const Matrix& matrix_;
  const PlannedRun& run_;
  std::string rows_;  // of trajectory.csv
  std::vector<FrameCost> costs_;
  std::vector<Answer> answers_;
  std::optional<FrameIndex> asked_;  // about this frame, and not answered yet
  std::vector<std::size_t> given_;   // in that frame
  std::size_t frames_done_ = 0;
  std::optional<RunRecord> record_;
  std::optional<std::string> not_made_;  // why the method could not be made
  Child child_;
};

/// Seconds that a method takes for one frame, from a trial of a few frames from its start on; nothing when
/// it did not get there.
std::optional<double> trial_seconds_per_frame(const Matrix& matrix, const PlannedRun& run);

}  // namespace relock
