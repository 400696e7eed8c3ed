#include "sequences/format.h"

#include <fmt/format.h>

#include <array>

#include "core/error.h"
#include "core/nearest.h"
#include "sequences/euroc.h"
#include "sequences/got10k.h"
#include "sequences/image_folder.h"
#include "sequences/otb.h"
#include "sequences/rosbag.h"
#include "sequences/tum.h"
#include "sequences/uav123.h"
#include "sequences/video.h"
#include "sequences/vot.h"

namespace relock {
namespace {

constexpr std::array kFormats{
    Format{"euroc", "a sequence of EuRoC MAV: mav0/cam0/data.csv and the pictures in mav0/cam0/data",
           recognises_euroc, find_euroc},
    Format{"tum", "a sequence of TUM RGB-D: rgb.txt and the pictures it names", recognises_tum, find_tum},
    Format{"got10k", "a sequence of GOT-10k: 00000001.jpg …, groundtruth.txt, cover.label, meta_info.ini",
           recognises_got10k, find_got10k},
    Format{"vot", "a sequence of VOT: groundtruth.txt, sequence, and color/00000001.jpg …", recognises_vot,
           find_vot},
    Format{"otb", "a sequence of OTB: img/0001.jpg … and groundtruth_rect.txt", recognises_otb, find_otb},
    Format{"uav123", "a sequence of UAV123: 000001.jpg … and anno/UAV123/NAME.txt, or that file",
           recognises_uav123, find_uav123},
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
