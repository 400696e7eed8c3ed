#pragma once

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "sequences/rosbag/message.h"

namespace relock {

/// The messages of one topic of pictures in a bag, in the order in which they were recorded. Only their places
/// are held; each is read when it is asked for.
class PictureTopic {
 public:
  /// Throws Error when the file is no bag or cut off, or `topic` or else the only topic of pictures is not there.
  PictureTopic(const std::filesystem::path& path, const std::optional<std::string>& topic);

  const std::string& topic() const { return topic_; }
  std::size_t messages() const { return messages_.size(); }
  /// The message's bytes, valid until the next call.
  MessageBytes bytes(std::size_t message);
  /// kImageType or kCompressedImageType.
  std::string_view type(std::size_t message) const { return messages_[message].getDataType(); }

  /// The same fault in a message: "flight.bag: message 41 of /camera: it …".
  Error fault_in(std::size_t message, std::string_view sentence) const;

 private:
  std::string file_, topic_;
  rosbag::Bag bag_;
  rosbag::View view_;
  std::vector<rosbag::MessageInstance> messages_;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace relock
