#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

namespace relock {

/// A message as a test puts it into a bag.
struct BagMessage {
  std::string topic, type;
  std::int64_t stamp_ns = 0;     ///< in the header
  std::int64_t recorded_ns = 0;  ///< when it reached the recorder
  std::vector<std::uint8_t> bytes;
};

/// A sensor_msgs/Image; its rows are as far apart as `padding` bytes more than they need. Recorded 12 ms later.
BagMessage image_message(const std::string& topic, std::int64_t stamp_ns, const cv::Mat& pixels,
                         const std::string& encoding, int padding = 0);
/// A sensor_msgs/CompressedImage; `ending` is that of a picture file. Recorded 12 ms later.
BagMessage compressed_message(const std::string& topic, std::int64_t stamp_ns, const cv::Mat& pixels,
                              const std::string& ending);

enum class BagPacking { none, bzip2, lz4 };
void write_bag(const std::filesystem::path& path, const std::vector<BagMessage>& messages,
               BagPacking packing = BagPacking::none);

}  // namespace relock
