#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/program.h"
#include "core/stage.h"

namespace relock {

/// Writes every stage into the folder, pictures as 1-filter.png, charts as 3-profile.svg; returns the files in their
/// order. Throws Error when one cannot be written or drawn.
std::vector<std::filesystem::path> write_stages(const std::vector<Stage>& stages,
                                                const std::filesystem::path& folder);

/// Names of the detectors that show their stages.
std::vector<std::string> explaining_detectors(const Methods& methods);

}  // namespace relock
