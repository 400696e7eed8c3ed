#pragma once

#include <iosfwd>
#include <string>

#include "core/recording.h"
#include "eval/trajectory.h"

namespace relock {

// trajectory.csv: everything a method said, one row for each sighting and at least one for each recorded
// frame. Columns:
//   frame, captured_ns  the recorded frame
//   report              sighting; nothing (delivered, and nothing said); given (the box handed over here, in
//                       the outline columns); failed (no answer for good); dropped; skipped; withheld (the protocol
//                       does not show it)
//   track               id of the target being followed, given or withheld
//   code                what was read
//   centre_kind, centre_x, centre_y
//   confidence
//   blur_direction_rad, blur_length_px
//   an outline          core/outline_csv.h
// Pixels have four decimals.

/// A sighting with its pixels rounded as the file has them.
Sighting as_stored(Sighting sighting);

/// `recording` names the targets and gives the times.
void write_trajectory(std::ostream& out, const Recording& recording, const Trajectory& trajectory);

/// The same piece by piece: the header line, then the rows of `trajectory.frames[frame]` for each frame.
std::string trajectory_header();
void append_report(std::string& text, const Recording& recording, const Trajectory& trajectory,
                   std::size_t frame);

/// Reads the frames back; `judged_from`, `failed_from` and `reads_codes` are in run.json and left as they
/// are. A trajectory that was cut short has fewer frames than the recording. Throws Error with file and line
/// on a frame out of order, a time that is not the recording's, an unknown target or report, a number that is
/// not finite.
void read_trajectory(std::istream& in, const std::string& file, const Recording& recording,
                     Trajectory& trajectory);

}  // namespace relock
