#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

#include "core/recording.h"
#include "sequences/description.h"

namespace relock {

// labels.csv: a header, then one row for each frame and target that is labelled. Columns, in any order:
//   frame              rank of the frame, from 0
//   target             its id; may be left out when there is one target
//   label              visible, absent or unlabelled; else it follows from visible_fraction
//   an outline         core/outline_csv.h; of the whole target, unoccluded and unblurred
//   projected_x, projected_y   image of the physical centre; for a quad it is found from the diagonals
//   visible_fraction   part of the outline in the picture and unoccluded; else its part in the picture
//   occluded_fraction  part of the outline hidden by something in the scene; else 0
//   blur_x, blur_y     image motion from the start to the end of the exposure, px
//   tilt_deg           between the target's normal and the line of sight
//   sigma_px           accuracy of this label; else recording.toml's
//   source             hand, spline, detector NAME, spline detector NAME (core/truth.h); else nobody said
// Frames without a row are unlabelled. An empty cell is "not given".

/// Where visible ends and absent begins, as the visible part of the outline (metrics.md section 1).
struct LabelLimits {
  double visible = 0.5;  ///< at least this much: visible
  double absent = 0.0;   ///< at most this much: absent; in between: unlabelled
};

/// What a visible part of the outline makes of a target.
Label label_of(double visible_fraction, const LabelLimits& limits);

/// The truth that an outline alone tells, for label files that say no more: visible is what lies in the
/// picture, and the label follows from it. Outside the picture altogether: absent, without an outline.
TargetTruth truth_of_outline(const Outline& outline, Size picture, const LabelLimits& limits);

/// Reads labels into `recording`, whose frames, picture and name are already there: fills targets and truth.
/// Throws Error with file and line on a frame that does not exist, an unknown column or target, a target
/// labelled twice, an outline outside the picture that is called visible.
void read_labels(std::istream& in, const std::string& file, const Description& description,
                 const LabelLimits& limits, Recording& recording);

/// Writes labels.csv, every column, so that `read_labels` gives the same truth to a ten-thousandth of a
/// pixel. The column `source` is there where a label states one.
void write_labels(std::ostream& out, const Recording& recording);

/// The same piece by piece, for whoever makes a recording longer than memory: the header, then in each frame the row of
/// each target (nothing for one that is unlabelled and whose place is unknown).
enum class SourceColumn : std::uint8_t { left_out, written };
void write_label_header(std::ostream& out, SourceColumn source = SourceColumn::left_out);
void write_label_row(std::ostream& out, FrameIndex frame, const Target& target, const TargetTruth& truth,
                     SourceColumn source = SourceColumn::left_out);

}  // namespace relock
