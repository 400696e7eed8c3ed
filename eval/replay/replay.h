#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/frame_source.h"
#include "core/method.h"
#include "core/schedule.h"
#include "eval/judgement/verdict.h"
#include "eval/replay/protocol.h"
#include "eval/replay/real_time.h"

namespace relock {

/// What it cost to ask the method about one frame, starts included.
struct FrameCost {
  FrameIndex frame = 0;
  Duration wall{0};
  Duration cpu{0};              ///< of the whole process
  std::int64_t peak_bytes = 0;  ///< most memory that the process has held so far
};

/// A method that threw, crashed or gave no answer in time, and where.
struct Failure {
  FrameIndex frame = 0;
  std::string what;
  std::string output = {};  ///< the last of what it wrote to stdout and stderr, where that was kept
};

struct Replay {
  Trajectory trajectory;
  std::vector<FrameCost> costs;   ///< of every frame that the method was asked about
  std::vector<Answer> answers;    ///< real time: of every frame that it answered
  std::vector<Failure> failures;  ///< of a start (its target only) or an answer (all targets, for good)
  /// The recording itself could not be read on from here: the trajectory ends before this frame.
  std::optional<Failure> cut_short;
};

struct ReplayOptions {
  Protocol protocol = Protocol::once;
  Gate gate;                 ///< by which `reset` judges losses
  bool reads_codes = false;  ///< as the method's registry entry declares
  std::vector<bool> asked;   ///< targets that the method is asked about; empty: all
  FrameIndex from = 0;       ///< frames before this one are withheld: where the run's anchor is
  /// Frames arrive in real time, and those for which the method is busy are Skipped. The first start of a target is
  /// then on the first startable frame that the method comes to; before it is started on any, looking takes no time.
  /// A method that has failed is not busy.
  std::optional<RealTime> real_time = {};
  /// Called before a frame is shown, with the targets whose box is handed over in it; if given.
  std::function<void(FrameIndex, const std::vector<std::size_t>& given)> asking;
  /// Called after every recorded frame with all that was said up to it, if given.
  std::function<void(const Replay& so_far)> reported;
};

/// For each target the first frame on which a method is judged (Trajectory::judged_from): `takes_boxes` as
/// Method has it; protocol, `asked` and `from` as ReplayOptions has them.
std::vector<std::optional<FrameIndex>> judged_from(const Recording& recording, const ReplayOptions& options,
                                                   bool takes_boxes);

/// Completes a trajectory whose method took its process down, or was stopped, while it was asked about
/// `frame`: it has failed for good from there on. `given`: targets whose box it was handed in that frame.
void fail_from(Trajectory& trajectory, FrameIndex frame, const std::vector<std::size_t>& given,
               const Schedule& schedule);

/// Shows the delivered frames to the method in order and writes down what it says. A method that throws is
/// scored as failed from there on, never left out; a source that throws cuts the replay short.
Replay replay(Method& method, FrameSource& source, const Recording& recording, const Schedule& schedule,
              const ReplayOptions& options);

}  // namespace relock
