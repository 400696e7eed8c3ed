#pragma once

#include <filesystem>

#include "sequences/format.h"

namespace relock {

// Format "got10k": GOT-10k.
//   NAME/00000001.jpg …
//   NAME/groundtruth.txt      x,y,w,h on each line; of the test set only the first is published
//   NAME/absence.label        1: the target is not there
//   NAME/cover.label          0 … 8: how many eighths of the target are visible
//   NAME/meta_info.ini        "anno_fps: 10Hz": the pictures' rate
// It is told from VOT's older layout by one of the last three, or by a folder called GOT-10k….
//
// Coordinates are 1-based pixels (its author in issue 6 of github.com/got-10k/toolkit). Times: timestamps.csv,
// a stated rate, else anno_fps, else 10 Hz, at which all of it is annotated.
//
// The one target is "target". visible_fraction is cover / 8, which counts what is hidden and what the picture
// cuts off; of what lies in the picture, the rest is occluded_fraction. A frame that is covered entirely and
// yet not absent is unlabelled: some files say so throughout (issue 20 there), and the toolkit's own score
// leaves these frames out. cut_by_image.label is not looked at: cover says how much.

bool recognises_got10k(const std::filesystem::path& path);
FoundRecording find_got10k(const std::filesystem::path& path, const OpenOptions& options);

}  // namespace relock
