#include "sequences/video.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "core/error.h"
#include "sequences/image_folder.h"
#include "sequences/sidecars.h"
#include "sequences/video/frames.h"
#include "sequences/video/index.h"

namespace relock {
namespace {

namespace fs = std::filesystem;

bool is_video(const fs::path& path) {
  constexpr std::array<std::string_view, 24> endings{
      ".mp4",  ".m4v",  ".mov", ".mkv",  ".webm", ".avi", ".ts",  ".mts", ".m2ts", ".mpg", ".mpeg", ".mjpeg",
      ".mjpg", ".h264", ".264", ".h265", ".hevc", ".265", ".wmv", ".flv", ".ogv",  ".3gp", ".nut",  ".y4m"};
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::find(endings.begin(), endings.end(), ending) != endings.end();
}

std::vector<fs::path> videos_in(const fs::path& folder) {
  std::vector<fs::path> all;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file() && is_video(entry.path())) all.push_back(entry.path());
  std::sort(all.begin(), all.end());
  return all;
}

/// Whether pictures are in the folder or in one right below it.
bool holds_pictures(const fs::path& folder) {
  const auto any = [](const fs::path& in) {
    const auto picture = [](const fs::directory_entry& entry) { return is_picture(entry.path()); };
    return std::any_of(fs::directory_iterator(in), fs::directory_iterator(), picture);
  };
  if (any(folder)) return true;
  return std::any_of(
      fs::directory_iterator(folder), fs::directory_iterator(),
      [&](const fs::directory_entry& entry) { return entry.is_directory() && any(entry.path()); });
}

fs::path only_video_in(const fs::path& folder) {
  const auto videos = videos_in(folder);
  if (videos.empty()) throw Error(fmt::format("{} holds no video", folder.string()));
  if (videos.size() > 1)
    throw Error(fmt::format("{} holds {} videos, of which {} is the first; name the one that is meant",
                            folder.string(), videos.size(), videos.front().filename().string()));
  return videos.front();
}

/// A rate that somebody states, for videos that state no times.
std::optional<double> stated_rate(const OpenOptions& options, const Description& description) {
  if (options.rate_hz) return options.rate_hz;
  if (description.rate_hz) return description.rate_hz;
  if (description.period) return 1.0 / seconds(*description.period);
  return {};
}

}  // namespace

bool recognises_video(const fs::path& path) {
  if (!fs::is_directory(path)) return is_video(path);
  return !videos_in(path).empty() && !holds_pictures(path);
}

FoundRecording find_video(const fs::path& path, const OpenOptions& options) {
  const bool in_folder = fs::is_directory(path);
  const fs::path video = in_folder ? only_video_in(path) : path;
  const Sidecars sidecars = in_folder ? sidecars_in(path) : sidecars_beside(path);
  FoundRecording found;
  found.description = read_description(sidecars.description, sidecars.name);
  found.labels = sidecars.labels;
  found.data = {video};

  VideoIndex index = index_video(video);
  if (fs::exists(sidecars.timestamps)) {
    index.captured = sidecar_times(sidecars.timestamps, index.keys.size(),
                                   video.string() + (index.cut_off ? ", which is cut off" : ""));
  } else if (index.by_rank) {
    const auto rate_hz = stated_rate(options, found.description);
    if (!rate_hz)
      throw Error(fmt::format("{} {}: add {}, or rate_hz to {}, or --rate", video.string(), index.untimed,
                              sidecars.timestamps.string(), sidecars.description.string()));
    index.captured = steady_times(index.keys.size(), *rate_hz);
    found.times_from = TimesFrom::stated_rate;
  }
  const auto shared = std::make_shared<const VideoIndex>(std::move(index));
  found.frames = [video, shared] { return open_video(video, shared); };
  return found;
}

}  // namespace relock
