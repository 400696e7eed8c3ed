#pragma once

#include <filesystem>

#include "sequences/format.h"

namespace relock {

// Format "video": a video file, or a folder that holds one and no pictures.
//
// What is told of it beside a file flight.mp4: flight.toml, flight.timestamps.csv and flight.labels.csv; in a
// folder: recording.toml, timestamps.csv and labels.csv. The name is the file's or the folder's.
//
// Capture times are those of timestamps.csv if there is one, else the container's own presentation times, to
// the nanosecond and with the epoch that they have: the first frame need not be at 0. Frames that the container
// skips are gaps, at their length; no frame rate is ever taken for a time. Where the container keeps no times
// (raw streams; AVI with reordered frames) or times that do not rise, timestamps.csv or a rate must be given.
// The frames are those that the container lists; of those that its edit list cuts out, none.
//
// Pictures are upright, as a player shows them; sequences/video/picture.h says more of pixels. Of several
// streams, the container's default is taken, else the best.

/// A file whose name ends as that of a video, or a folder with such a file and no pictures in it or below it.
bool recognises_video(const std::filesystem::path& path);
/// Throws Error when the file is no video that can be decoded, when its frames have no times, or when
/// timestamps.csv has not as many times as the video has frames.
///
/// The pictures' `image` throws Error, naming file, frame and time, at a frame that is lost or damaged or has
/// another size; then also at those after it, up to the next key frame. A file that is cut off has one frame
/// more than can be decoded: the one at which it is cut.
FoundRecording find_video(const std::filesystem::path& path, const OpenOptions& options);

}  // namespace relock
