#pragma once

#include <filesystem>
#include <memory>
#include <optional>
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

/// What a format knows of time itself. Earlier fields are asked first.
struct OwnTimes {
  std::vector<Time> captured = {};             ///< of each picture
  std::optional<double> stated_rate_hz = {};   ///< less than what --rate and recording.toml state
  std::optional<double> assumed_rate_hz = {};  ///< usual for the format
};

struct TimedPictures {
  std::vector<std::filesystem::path> pictures;
  std::vector<Time> captured;  ///< as many
  TimesFrom times_from = TimesFrom::recorded;
};

/// Puts times to the pictures of `folder`: of timestamps.csv in `sidecars` (which may also name the
/// pictures, and so choose among them), else of the format, else at the rate that --rate, recording.toml, the
/// format itself states, or that is usual. Throws Error when there are no pictures, nothing tells of time, or
/// not as many times as pictures.
TimedPictures timed_pictures(const std::filesystem::path& folder, std::vector<std::filesystem::path> pictures,
                             const std::filesystem::path& sidecars, const Description& description,
                             const OpenOptions& options, const OwnTimes& own);
/// Makes them the frames of a recording.
void show(TimedPictures pictures, FoundRecording& found);

/// Capture times at a steady rate, the first frame at 0; each is rounded by itself, so that no rounding adds
/// up.
std::vector<Time> steady_times(std::size_t frames, double rate_hz);

/// Pictures in files, decoded one at a time. Throws Error when there is none, or not one time for each.
std::unique_ptr<FrameSource> open_pictures(std::vector<std::filesystem::path> pictures,
                                           std::vector<Time> captured);

}  // namespace relock
