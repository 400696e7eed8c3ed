#include "sequences/video.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "core/error.h"
#include "sequences/image_folder.h"
#include "sequences/timestamps.h"
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

/// A recording's video and the files beside it.
struct VideoFiles {
  fs::path video, description, timestamps, labels;
  std::string name;
};

VideoFiles files_of(const fs::path& path) {
  if (!fs::is_directory(path)) {
    const fs::path stem = path.parent_path() / path.stem();
    return {path, stem.string() + ".toml", stem.string() + ".timestamps.csv", stem.string() + ".labels.csv",
            path.stem().string()};
  }
  const auto videos = videos_in(path);
  if (videos.empty()) throw Error(fmt::format("{} holds no video", path.string()));
  if (videos.size() > 1)
    throw Error(fmt::format("{} holds {} videos, of which {} is the first; name the one that is meant",
                            path.string(), videos.size(), videos.front().filename().string()));
  return {videos.front(), path / "recording.toml", path / "timestamps.csv", path / "labels.csv",
          folder_name(path)};
}

/// Of the sidecar if there is one, else the container's, else at the rate that is stated.
std::vector<Time> capture_times(const VideoFiles& files, const VideoIndex& index,
                                std::optional<double> rate_hz, TimesFrom& from) {
  const std::string video = files.video.string();
  if (fs::exists(files.timestamps)) {
    auto times = read_timestamps(files.timestamps).captured;
    if (times.size() != index.keys.size())
      throw Error(fmt::format("{}: there are {} times for the {} frames of {}{}", files.timestamps.string(),
                              times.size(), index.keys.size(), video,
                              index.cut_off ? ", which is cut off" : ""));
    return times;
  }
  if (!index.by_rank) return index.captured;
  if (!rate_hz)
    throw Error(fmt::format("{} {}: add {}, or rate_hz to {}, or --rate", video, index.untimed,
                            files.timestamps.string(), files.description.string()));
  from = TimesFrom::stated_rate;
  return steady_times(index.keys.size(), *rate_hz);
}

}  // namespace

bool recognises_video(const fs::path& path) {
  if (!fs::is_directory(path)) return is_video(path);
  return !videos_in(path).empty() && !holds_pictures(path);
}

FoundRecording find_video(const fs::path& path, const OpenOptions& options) {
  const VideoFiles files = files_of(path);
  FoundRecording found;
  found.description = read_description(files.description, files.name);
  found.labels = files.labels;
  found.data = {files.video};
  VideoIndex index = index_video(files.video);
  std::optional<double> rate_hz = options.rate_hz ? options.rate_hz : found.description.rate_hz;
  if (!rate_hz && found.description.period) rate_hz = 1.0 / seconds(*found.description.period);
  index.captured = capture_times(files, index, rate_hz, found.times_from);
  const auto shared = std::make_shared<const VideoIndex>(std::move(index));
  found.frames = [video = files.video, shared] { return open_video(video, shared); };
  return found;
}

}  // namespace relock
