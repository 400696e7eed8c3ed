#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "core/frame_source.h"
#include "sequences/format.h"

namespace relock {

// Format "folder": the pictures of FOLDER/images/* if there is such a folder, else of FOLDER/*, in order of
// name (or as timestamps.csv names them). Capture times are those of FOLDER/timestamps.csv, else a steady
// rate: --rate if given, else the description's, the first frame at 0.

/// A folder, whatever is in it.
bool recognises_image_folder(const std::filesystem::path& path);
/// Throws Error when there are no pictures, no times, or not as many times as pictures.
FoundRecording find_image_folder(const std::filesystem::path& path, const OpenOptions& options);

// What other formats that keep pictures as files are made of, too.

/// Whether a file's name is that of a picture (jpg, jpeg, png, bmp, pgm, ppm, tif, tiff, webp).
bool is_picture(const std::filesystem::path& path);
/// The pictures in a folder, not in those below it, in natural order of name: frame2 before frame10.
std::vector<std::filesystem::path> pictures_in(const std::filesystem::path& folder);

/// Capture times at a steady rate, the first frame at 0; each is rounded by itself, so that no rounding adds
/// up.
std::vector<Time> steady_times(std::size_t frames, double rate_hz);

/// Pictures in files, decoded one at a time. Throws Error when there is none, or not one time for each.
std::unique_ptr<FrameSource> open_pictures(std::vector<std::filesystem::path> pictures,
                                           std::vector<Time> captured);

}  // namespace relock
