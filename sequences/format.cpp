#include "sequences/format.h"

#include <fmt/format.h>

#include <array>

#include "core/error.h"
#include "core/nearest.h"
#include "sequences/image_folder.h"
#include "sequences/rosbag.h"
#include "sequences/video.h"

namespace relock {
namespace {

constexpr std::array kFormats{
    Format{"video", "a video file (mp4, mkv, avi, …), or a folder that holds one and no pictures",
           recognises_video, find_video},
    Format{"rosbag", "a ROS 1 bag with one topic of pictures, or --topic to choose it", recognises_rosbag,
           find_rosbag},
    Format{"folder", "a folder of pictures, or with a folder images/ of them, and timestamps.csv",
           recognises_image_folder, find_image_folder},
};

}  // namespace

std::span<const Format> formats() { return kFormats; }

const Format& format_of(const std::filesystem::path& path, const std::optional<std::string>& name) {
  if (!std::filesystem::exists(path)) throw Error(fmt::format("{} does not exist", path.string()));
  std::vector<std::string> names;
  for (const Format& format : kFormats) {
    if (name ? format.name == *name : format.recognises(path)) return format;
    names.emplace_back(format.name);
  }
  if (name)
    throw Error(fmt::format("no format is called \"{}\"{}; there are {}", *name, did_you_mean(*name, names),
                            fmt::join(names, ", ")));
  throw Error(fmt::format("{} is no recording that relock knows; --format may be {}", path.string(),
                          fmt::join(names, ", ")));
}

}  // namespace relock
