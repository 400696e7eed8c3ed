#pragma once

#include <filesystem>

namespace relock {

/// The folder of the recordings that relock comes with: beside the installed program (share/relock/recordings
/// of its prefix), else in the sources that it was built from.
std::filesystem::path embedded_recordings();
/// The same for the program at this place.
std::filesystem::path embedded_recordings(const std::filesystem::path& program);

/// Where a recording is: as given, or of that name among those that relock comes with.
std::filesystem::path recording_path(const std::filesystem::path& given);

}  // namespace relock
