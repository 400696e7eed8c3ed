#pragma once

#include <filesystem>

#include "sequences/format.h"

namespace relock {

// Format "rosbag": a ROS 1 bag, uncompressed or packed with bzip2 or LZ4, whose pictures are messages
// sensor_msgs/Image (mono8, bgr8, rgb8, bgra8, rgba8, 8-bit Bayer, yuv422) or sensor_msgs/CompressedImage of one
// topic. Beside flight.bag may be flight.toml, flight.timestamps.csv and flight.labels.csv, as beside a video.
//
// Capture times are the header stamps: the times at which messages were recorded are later by the transport.
// Messages lie in order of recording, so that stamps may be a little out of order: frames are in order of stamp.
// A build without the ROS libraries knows the format and says what to install.

/// A file called *.bag.
bool recognises_rosbag(const std::filesystem::path& path);
/// Throws Error when it is no bag or cut off; when the topic is not there or not one of pictures, or none is
/// named and there are several; when two frames have one stamp, or a stamp is a second behind one before it.
/// The pictures' `image` throws Error, naming the message, on a picture of another kind or another size.
FoundRecording find_rosbag(const std::filesystem::path& path, const OpenOptions& options);

}  // namespace relock
