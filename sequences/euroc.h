#pragma once

#include <filesystem>

#include "sequences/format.h"

namespace relock {

// Format "euroc": EuRoC MAV and those that took over its layout (TUM-VI, the ASL format). One camera of a
// sequence: NAME/mav0/cam0/data.csv, "#timestamp [ns],filename" and then one line for each picture in
// NAME/mav0/cam0/data/. The path is NAME, NAME/mav0 or the camera's folder, which may be another one than
// cam0 and then adds "-cam1" to the name.
//
// Times are data.csv's, nanoseconds. There are no labels but labels.csv; it, timestamps.csv and
// recording.toml are in NAME (or in the camera's folder when that is not below mav0).

bool recognises_euroc(const std::filesystem::path& path);
FoundRecording find_euroc(const std::filesystem::path& path, const OpenOptions& options);

}  // namespace relock
