#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "core/frame_source.h"
#include "sequences/description.h"

namespace relock {

/// Opens a folder of pictures as a recording: FOLDER/images/* if there is such a folder, else FOLDER/*, in
/// order of name (or as timestamps.csv names them). Capture times are those of FOLDER/timestamps.csv, else a
/// steady rate: `rate_hz` if given, else the description's period, the first frame at 0. Throws Error when
/// there are no pictures, no times, or not as many times as pictures.
std::unique_ptr<FrameSource> open_image_folder(const std::filesystem::path& folder,
                                               const Description& description,
                                               std::optional<double> rate_hz = {});

/// Whether a file's name is that of a picture (jpg, jpeg, png, bmp, pgm, ppm, tif, tiff, webp).
bool is_picture(const std::filesystem::path& path);

}  // namespace relock
