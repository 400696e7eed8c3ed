#pragma once

#include <filesystem>

#include "sequences/format.h"

namespace relock {

// Format "tum": TUM RGB-D. NAME/rgb.txt lists the colour pictures, "timestamp filename" on each line, the name
// from NAME on ("rgb/1305031102.175304.png"); lines that begin with # are comments.
//
// Times are rgb.txt's, in seconds with decimals, taken digit by digit to the nanosecond. There are no labels
// but labels.csv (groundtruth.txt is the camera's path, not a target's).

bool recognises_tum(const std::filesystem::path& path);
FoundRecording find_tum(const std::filesystem::path& path, const OpenOptions& options);

}  // namespace relock
