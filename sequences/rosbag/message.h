#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string_view>

#include "core/time.h"

// The two kinds of messages that hold pictures, read from their bytes: the headers that ROS generates of them are
// not C++20. http://wiki.ros.org/msg has the encoding; the fields are those of sensor_msgs/Image and
// sensor_msgs/CompressedImage. All functions throw Error, without saying where, on a message that ends too early.

namespace relock {

using MessageBytes = std::span<const std::uint8_t>;

constexpr std::string_view kImageType = "sensor_msgs/Image";
constexpr std::string_view kCompressedImageType = "sensor_msgs/CompressedImage";

/// When the picture was captured, by the message's header.
Time stamp_of(MessageBytes message);

/// The pixels of a message of that type as CV_8UC1 or CV_8UC3 (BGR): those of the message itself if they are so
/// already, else converted into `buffer`. Throws Error on an encoding that is unknown or not of 8 bits a channel.
cv::Mat pixels_of(MessageBytes message, std::string_view type, cv::Mat& buffer);

}  // namespace relock
