#pragma once

#include <iosfwd>

#include "eval/judgement/evaluation.h"

namespace relock {

// events.csv: losses and searches of every target, in order of time. Columns:
//   event          loss, acquire, reacquire or resume
//   target
//   begin_s        loss: early end of the onset (the last Hold; rule b: the last Hit); else where the
//                  search began
//   begin_late_s   loss: late end of the onset, its first scored frame
//   end_s          loss: how long it was watched; else when the lock began
//   duration_s     end_s - begin_s; for a loss that recovered, the time to recover
//   rule           loss: a or b
//   kind           loss: Silent, WrongId, Drift or Declared
//   ended_by       loss: recovered, chance, target_left, reset, labels_stopped, recording_stopped;
//                  else locked or nothing
//   begin_frame, first_lost_frame, declared_frame, end_frame
//   slots, slots_recorded, slots_injected, slots_skipped, blur_px, displacement_d, border_px, tilt_deg,
//   size_px        loss: eval/judgement/circumstances.h; empty where not known
// Times are seconds from the first recorded frame.

void write_events(std::ostream& out, const Recording& recording, const Trajectory& trajectory,
                  const Evaluation& evaluation);

// verdicts.csv: frame, target, verdict, state, error_px, for every recorded frame and target.
void write_verdicts(std::ostream& out, const Recording& recording, const Evaluation& evaluation);

}  // namespace relock
