#include "sequences/sidecars.h"

#include <fmt/format.h>

#include "core/error.h"
#include "sequences/description.h"
#include "sequences/timestamps.h"

namespace relock {

Sidecars sidecars_in(const std::filesystem::path& folder) {
  return {folder_name(folder), folder / "recording.toml", folder / "timestamps.csv", folder / "labels.csv"};
}

Sidecars sidecars_beside(const std::filesystem::path& file) {
  const std::string stem = (file.parent_path() / file.stem()).string();
  return {file.stem().string(), stem + ".toml", stem + ".timestamps.csv", stem + ".labels.csv"};
}

std::vector<Time> sidecar_times(const std::filesystem::path& timestamps, std::size_t frames,
                                const std::string& recording) {
  auto times = read_timestamps(timestamps).captured;
  if (times.size() != frames)
    throw Error(fmt::format("{}: there are {} times for the {} frames of {}", timestamps.string(),
                            times.size(), frames, recording));
  return times;
}

}  // namespace relock
