#include "tests/sequences/rosbag/write_bag.h"

#include <rosbag/bag.h>

#include <opencv2/imgcodecs.hpp>

namespace relock {
namespace {

constexpr std::int64_t kTransport_ns = 12'000'000;

void put_number(std::vector<std::uint8_t>& bytes, std::size_t number) {
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(number >> shift));
}
void put_text(std::vector<std::uint8_t>& bytes, const std::string& text) {
  put_number(bytes, text.size());
  bytes.insert(bytes.end(), text.begin(), text.end());
}
void put_header(std::vector<std::uint8_t>& bytes, std::int64_t stamp_ns) {
  put_number(bytes, 7);
  put_number(bytes, static_cast<std::size_t>(stamp_ns / 1'000'000'000));
  put_number(bytes, static_cast<std::size_t>(stamp_ns % 1'000'000'000));
  put_text(bytes, "camera");
}

}  // namespace

BagMessage image_message(const std::string& topic, std::int64_t stamp_ns, const cv::Mat& pixels,
                         const std::string& encoding, int padding) {
  BagMessage message{topic, "sensor_msgs/Image", stamp_ns, stamp_ns + kTransport_ns, {}};
  const std::size_t row = pixels.elemSize() * static_cast<std::size_t>(pixels.cols);
  const std::size_t step = row + static_cast<std::size_t>(padding);
  put_header(message.bytes, stamp_ns);
  put_number(message.bytes, static_cast<std::size_t>(pixels.rows));
  put_number(message.bytes, static_cast<std::size_t>(pixels.cols));
  put_text(message.bytes, encoding);
  message.bytes.push_back(0);
  put_number(message.bytes, step);
  put_number(message.bytes, step * static_cast<std::size_t>(pixels.rows));
  for (int y = 0; y < pixels.rows; ++y) {
    message.bytes.insert(message.bytes.end(), pixels.ptr(y), pixels.ptr(y) + row);
    message.bytes.insert(message.bytes.end(), static_cast<std::size_t>(padding), 0xEE);
  }
  return message;
}

BagMessage compressed_message(const std::string& topic, std::int64_t stamp_ns, const cv::Mat& pixels,
                              const std::string& ending) {
  BagMessage message{topic, "sensor_msgs/CompressedImage", stamp_ns, stamp_ns + kTransport_ns, {}};
  std::vector<std::uint8_t> file;
  cv::imencode("." + ending, pixels, file);
  put_header(message.bytes, stamp_ns);
  put_text(message.bytes, "bgr8; " + ending + " compressed bgr8");
  put_number(message.bytes, file.size());
  message.bytes.insert(message.bytes.end(), file.begin(), file.end());
  return message;
}

}  // namespace relock

// How the library learns of a message that was not generated for it.
namespace ros::message_traits {
template <>
struct IsMessage<relock::BagMessage> : TrueType {};
template <>
struct MD5Sum<relock::BagMessage> {
  static const char* value(const relock::BagMessage& message) {
    return message.type == "sensor_msgs/Image" ? "060021388200f6f0f447d0fcd9c64743"
                                               : "8f7a12909da2c9d3332d540a0977563f";
  }
};
template <>
struct DataType<relock::BagMessage> {
  static const char* value(const relock::BagMessage& message) { return message.type.c_str(); }
};
template <>
struct Definition<relock::BagMessage> {
  static const char* value(const relock::BagMessage&) { return "std_msgs/Header header\n"; }
};
}  // namespace ros::message_traits

namespace ros::serialization {
template <>
struct Serializer<relock::BagMessage> {
  template <class Stream>
  static void write(Stream& stream, const relock::BagMessage& message) {
    std::copy(message.bytes.begin(), message.bytes.end(),
              stream.advance(static_cast<std::uint32_t>(message.bytes.size())));
  }
  static std::uint32_t serializedLength(const relock::BagMessage& message) {
    return static_cast<std::uint32_t>(message.bytes.size());
  }
};
}  // namespace ros::serialization

namespace relock {

static ros::Time ros_time(std::int64_t nanoseconds) {
  return ros::Time().fromNSec(static_cast<std::uint64_t>(nanoseconds));
}

void write_bag(const std::filesystem::path& path, const std::vector<BagMessage>& messages,
               BagPacking packing) {
  rosbag::Bag bag(path.string(), rosbag::bagmode::Write);
  bag.setCompression(packing == BagPacking::none    ? rosbag::compression::Uncompressed
                     : packing == BagPacking::bzip2 ? rosbag::compression::BZ2
                                                    : rosbag::compression::LZ4);
  for (const BagMessage& message : messages) bag.write(message.topic, ros_time(message.recorded_ns), message);
  bag.close();
}

}  // namespace relock
