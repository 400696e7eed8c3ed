#include "sequences/rosbag/message.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>

#include "core/error.h"
#include "sequences/encoded_picture.h"

namespace relock {
namespace {

/// Takes field after field from the front: numbers little-endian, texts and arrays behind their length.
class Fields {
 public:
  explicit Fields(MessageBytes bytes) : rest_(bytes) {}

  MessageBytes bytes(std::size_t count) {
    if (rest_.size() < count) throw Error("its message ends too early");
    const MessageBytes taken = rest_.first(count);
    rest_ = rest_.subspan(count);
    return taken;
  }
  std::uint8_t byte() { return bytes(1)[0]; }
  std::uint32_t number() {
    const MessageBytes b = bytes(4);
    return b[0] | std::uint32_t{b[1]} << 8 | std::uint32_t{b[2]} << 16 | std::uint32_t{b[3]} << 24;
  }
  MessageBytes array() { return bytes(number()); }
  std::string_view text() {
    const MessageBytes letters = array();
    return {reinterpret_cast<const char*>(letters.data()), letters.size()};
  }
  Time header() {
    number();  // its sequence number
    const std::int64_t whole = number(), nanoseconds = number();
    text();  // the frame of reference
    return time_ns(whole * 1'000'000'000 + nanoseconds);
  }

 private:
  MessageBytes rest_;
};

struct Encoding {
  std::string_view name;
  int type;        // of the stored pixels
  int conversion;  // to BGR; kAsStored if none is needed
};
constexpr int kAsStored = -1;

// OpenCV names a Bayer pattern by the second row's second and third pixel, ROS by the first four.
constexpr std::array kEncodings{
    Encoding{"mono8", CV_8UC1, kAsStored},
    Encoding{"8UC1", CV_8UC1, kAsStored},
    Encoding{"bgr8", CV_8UC3, kAsStored},
    Encoding{"8UC3", CV_8UC3, kAsStored},
    Encoding{"rgb8", CV_8UC3, cv::COLOR_RGB2BGR},
    Encoding{"bgra8", CV_8UC4, cv::COLOR_BGRA2BGR},
    Encoding{"8UC4", CV_8UC4, cv::COLOR_BGRA2BGR},
    Encoding{"rgba8", CV_8UC4, cv::COLOR_RGBA2BGR},
    Encoding{"bayer_rggb8", CV_8UC1, cv::COLOR_BayerBG2BGR},
    Encoding{"bayer_bggr8", CV_8UC1, cv::COLOR_BayerRG2BGR},
    Encoding{"bayer_gbrg8", CV_8UC1, cv::COLOR_BayerGR2BGR},
    Encoding{"bayer_grbg8", CV_8UC1, cv::COLOR_BayerGB2BGR},
    Encoding{"yuv422", CV_8UC2, cv::COLOR_YUV2BGR_UYVY},
    Encoding{"yuv422_yuy2", CV_8UC2, cv::COLOR_YUV2BGR_YUY2},
};

const Encoding& encoding_called(std::string_view name) {
  const auto found = std::find_if(kEncodings.begin(), kEncodings.end(),
                                  [&](const Encoding& encoding) { return encoding.name == name; });
  if (found != kEncodings.end()) return *found;
  const bool wide = name.find("16") != name.npos || name.find("32") != name.npos;
  throw Error(fmt::format(
      "its encoding \"{}\" {}", name,
      wide ? "has more than 8 bits a channel; record it as mono8 or bgr8" : "is none that relock reads"));
}

cv::Mat image_pixels(Fields fields, cv::Mat& buffer) {
  fields.header();
  const std::uint32_t height = fields.number(), width = fields.number();
  const Encoding& encoding = encoding_called(fields.text());
  fields.byte();  // endianness, of wider encodings
  const std::size_t step = fields.number();
  const MessageBytes data = fields.array();

  constexpr std::uint32_t most = 1 << 16;  // px
  const std::size_t row = std::size_t{width} * static_cast<std::size_t>(CV_ELEM_SIZE(encoding.type));
  if (width == 0 || height == 0 || width > most || height > most || step < row ||
      data.size() < step * (height - 1) + row)
    throw Error(fmt::format("it has {} bytes and says that it is {}x{}", data.size(), width, height));
  // A Mat has no const pixels; these are not written to.
  const cv::Mat stored(static_cast<int>(height), static_cast<int>(width), encoding.type,
                       const_cast<std::uint8_t*>(data.data()), step);
  if (encoding.conversion == kAsStored) return stored;
  cv::cvtColor(stored, buffer, encoding.conversion);
  return buffer;
}

cv::Mat compressed_pixels(Fields fields, cv::Mat& buffer) {
  fields.header();
  if (fields.text().find("compressedDepth") != std::string_view::npos)
    throw Error("it is a picture of depths, not of light");
  buffer = decode_picture(fields.array());
  return buffer;
}

}  // namespace

Time stamp_of(MessageBytes message) { return Fields(message).header(); }

cv::Mat pixels_of(MessageBytes message, std::string_view type, cv::Mat& buffer) {
  return type == kCompressedImageType ? compressed_pixels(Fields(message), buffer)
                                      : image_pixels(Fields(message), buffer);
}

}  // namespace relock
