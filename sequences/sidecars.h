#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/time.h"

namespace relock {

/// The files that tell of a recording beside the one that holds its pictures.
struct Sidecars {
  std::string name;  ///< the recording's, unless the description has another
  std::filesystem::path description, timestamps, labels;
};

/// Those of a recording in a folder of its own: recording.toml, timestamps.csv, labels.csv in it.
Sidecars sidecars_in(const std::filesystem::path& folder);
/// Those beside a file flight.mp4: flight.toml, flight.timestamps.csv, flight.labels.csv.
Sidecars sidecars_beside(const std::filesystem::path& file);

/// The times of timestamps.csv. Throws Error unless they are `frames`; `recording` is what they are times of.
std::vector<Time> sidecar_times(const std::filesystem::path& timestamps, std::size_t frames,
                                const std::string& recording);

}  // namespace relock
