#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/recording.h"
#include "eval/trajectory.h"

namespace relock {

/// Exactly one for each target and recorded frame: the first that applies (metrics.md section 3).
enum class Verdict : std::uint8_t {
  NotStarted,     ///< before the method was started on this target, or the frame is withheld from it
  Dropped,        ///< the frame is missing from the delivery
  Skipped,        ///< real-time replay: the method was busy
  Given,          ///< the method was handed the true box here
  Unlabelled,     ///< no label
  Hit,            ///< visible, e <= 0.25 D, no wrong code
  WrongId,        ///< visible, e <= 0.5 D, code wrong
  Stray,          ///< visible, reported, not a Hit
  Miss,           ///< visible, nothing reported
  FalseAlarm,     ///< absent, and a sighting claims it
  CorrectReject,  ///< absent otherwise
};
constexpr std::size_t kVerdicts = 11;
std::string_view to_string(Verdict verdict);
/// One letter for timelines: ' ', '.', '-', 'g', '?', 'H', 'W', 'S', 'M', 'F', 'r'.
char letter(Verdict verdict);
/// Hit, WrongId, Stray or Miss.
bool scored(Verdict verdict);

/// When a sighting is a Hit and when it still holds.
struct Gate {
  enum class Measure : std::uint8_t {
    centre,  ///< position error e: Hit at e <= 0.25 D, Hold at e <= 0.5 D
    iou,     ///< overlap of the outlines' boxes: Hit at >= 0.5, Hold at >= 0.25
  };
  Measure measure = Measure::centre;
  double hit = 0.25;  ///< centre: in D; iou: overlap
  double hold = 0.5;  ///< centre: in D; iou: overlap
  static Gate iou() { return {Measure::iou, 0.5, 0.25}; }
  friend bool operator==(const Gate&, const Gate&) = default;
};
/// "centre 0.25 D, hold 0.5 D": every score file names its gate.
std::string to_string(const Gate& gate);
/// "centre" or "iou". Throws Error otherwise.
Gate parse_gate(std::string_view text);

/// The verdict on one target in one frame, and what it rests on.
struct Judgement {
  Verdict verdict = Verdict::NotStarted;
  bool hold = false;     ///< visible, reported within the hold gate, no wrong code; every Hit is one
  bool uncoded = false;  ///< a Hit by place of a method that reads codes but read none here
  bool failed = false;   ///< a Miss because the method had crashed or timed out
  int sighting = -1;     ///< index of the sighting that Hit, WrongId, Stray or FalseAlarm rests on; else -1
  double error_px = std::numeric_limits<double>::quiet_NaN();  ///< e of that sighting, where visible
  friend bool operator==(const Judgement& a, const Judgement& b) {
    return a.verdict == b.verdict && a.hold == b.hold && a.uncoded == b.uncoded && a.failed == b.failed &&
           a.sighting == b.sighting &&
           (a.error_px == b.error_px || (a.error_px != a.error_px && b.error_px != b.error_px));
  }
};

/// The verdicts on all targets in one frame. Every sighting counts exactly once: behind a target's verdict,
/// among the spurious or among the ignored.
struct FrameJudgement {
  std::vector<Judgement> targets;
  int spurious = 0;  ///< sightings of nothing
  int ignored = 0;   ///< sightings of what is not judged here
};

/// Judges one recorded frame (metrics.md section 3).
FrameJudgement judge_frame(const Recording& recording, std::size_t frame, const FrameReport& report,
                           const Trajectory& trajectory, const Gate& gate);

}  // namespace relock
