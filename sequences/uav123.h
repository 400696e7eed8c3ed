#pragma once

#include <filesystem>

#include "sequences/format.h"

namespace relock {

// Format "uav123": UAV123, UAV20L and UAV123_10fps.
//   ROOT/data_seq/SET/NAME/000001.jpg …
//   ROOT/anno/SET/NAME.txt              x,y,w,h on each line; target "target"
//   ROOT/configSeqs.m                   which pictures each annotation is of
// The path is the folder of pictures, whose annotation is ROOT/anno/SET/NAME.txt, or in flat copies NAME.txt
// inside the folder or beside it; or it is an annotation file in ROOT/anno/SET.
//
// Long recordings are cut into NAME_1, NAME_2 … over the one folder NAME. Such a piece is opened by its
// annotation file, "ROOT/anno/SET/NAME_2.txt", and configSeqs.m says from which picture to which it goes;
// timestamps.csv and recording.toml of the folder hold for its pictures too (times count all of the folder's
// pictures), labels.csv does not.
//
// Coordinates are 1-based pixels, as in OTB, for whose MATLAB code it was made. Nobody states times:
// timestamps.csv, a stated rate, else 30 Hz, or 10 Hz where SET is called …10fps.

bool recognises_uav123(const std::filesystem::path& path);
FoundRecording find_uav123(const std::filesystem::path& path, const OpenOptions& options);

}  // namespace relock
