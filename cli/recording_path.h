#pragma once

#include <filesystem>

namespace relock {

/// Where a recording is: as given, or of that name among those that relock comes with.
std::filesystem::path recording_path(const std::filesystem::path& given);

}  // namespace relock
