#pragma once

#include <filesystem>

#include "sequences/format.h"

namespace relock {

// Format "otb": the Object Tracking Benchmark (OTB-50, OTB-100), and TColor-128 and others in its layout.
//   NAME/img/0001.jpg …
//   NAME/groundtruth_rect.txt          x,y,w,h on each line; target "target"
//   NAME/groundtruth_rect.1.txt, …     one for each target, called "1", "2"; empty ones are passed over, and
//                                      one that is left alone is "target" (Human4)
//
// Coordinates are 1-based pixels, as in MATLAB, for which it was made: "1,1,w,h" begins at the picture's very
// corner and is Box{-0.5, -0.5, w, h}. Nobody states times: timestamps.csv, a stated rate, else 30 Hz.
//
// One line for each picture. Five published sequences label only part of theirs, and are known by name and
// count: David (from picture 300 on), Diving, Football1, Freeman3 and Freeman4 (the first 215, 74, 460, 283).

bool recognises_otb(const std::filesystem::path& path);
FoundRecording find_otb(const std::filesystem::path& path, const OpenOptions& options);

}  // namespace relock
