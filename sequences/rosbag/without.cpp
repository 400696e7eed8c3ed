// In place of the reader of bags, where the ROS libraries are not installed.

#include <fmt/format.h>

#include "core/error.h"
#include "sequences/rosbag.h"

namespace relock {

bool recognises_rosbag(const std::filesystem::path& path) { return path.extension() == ".bag"; }

FoundRecording find_rosbag(const std::filesystem::path& path, const OpenOptions&) {
  throw Error(fmt::format(
      "{}: relock was built without ROS bags; install librosbag-storage-dev and build again", path.string()));
}

}  // namespace relock
