#include "sequences/rosbag/bag.h"

#include <console_bridge/console.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>

namespace relock {
namespace {

bool holds_pictures(const std::string& type) { return type == kImageType || type == kCompressedImageType; }

/// "/a/image (42 sensor_msgs/Image), …"
std::string listed(const std::map<std::string, std::pair<std::string, std::size_t>>& topics) {
  std::vector<std::string> all;
  for (const auto& [name, kind] : topics)
    all.push_back(fmt::format("{} ({} {})", name, kind.second, kind.first));
  return fmt::format("{}", fmt::join(all, ", "));
}

void open(rosbag::Bag& bag, const std::string& file) {
  console_bridge::setLogLevel(console_bridge::CONSOLE_BRIDGE_LOG_NONE);  // relock says itself what is wrong
  try {
    bag.open(file, rosbag::bagmode::Read);
  } catch (const rosbag::BagUnindexedException&) {
    throw Error(fmt::format("{} was never closed; repair it with: rosbag reindex {}", file, file));
  } catch (const std::exception& fault) {
    throw Error(
        fmt::format("{} is no ROS 1 bag, or is cut off ({}); a cut one is repaired by: rosbag reindex {}",
                    file, fault.what(), file));
  }
}

/// Type and number of messages of each topic.
std::map<std::string, std::pair<std::string, std::size_t>> topics_of(rosbag::Bag& bag) {
  std::map<std::string, std::pair<std::string, std::size_t>> topics;
  rosbag::View all(bag);
  for (const rosbag::ConnectionInfo* connection : all.getConnections()) {
    const std::string& name = connection->topic;
    topics[name] = {connection->datatype, rosbag::View(bag, rosbag::TopicQuery(name)).size()};
  }
  return topics;
}

std::string chosen_topic(rosbag::Bag& bag, const std::string& file,
                         const std::optional<std::string>& wanted) {
  const auto topics = topics_of(bag);
  auto pictures = topics;
  for (auto at = pictures.begin(); at != pictures.end();)
    at = holds_pictures(at->second.first) ? std::next(at) : pictures.erase(at);
  if (pictures.empty())
    throw Error(fmt::format("{} holds no pictures; its topics are {}", file,
                            topics.empty() ? "none" : listed(topics)));
  if (wanted) {
    if (pictures.count(*wanted) > 0) return *wanted;
    if (const auto other = topics.find(*wanted); other != topics.end())
      throw Error(fmt::format("{}: the messages of topic {} are {} and no pictures; there are {}", file,
                              *wanted, other->second.first, listed(pictures)));
    throw Error(fmt::format("{} has no topic {}; those of pictures are {}", file, *wanted, listed(pictures)));
  }
  if (pictures.size() > 1)
    throw Error(fmt::format("{} has pictures on several topics; choose one with --topic: {}", file,
                            listed(pictures)));
  return pictures.begin()->first;
}

}  // namespace

PictureTopic::PictureTopic(const std::filesystem::path& path, const std::optional<std::string>& topic)
    : file_(path.string()) {
  open(bag_, file_);
  try {
    topic_ = chosen_topic(bag_, file_, topic);
    view_.addQuery(bag_, rosbag::TopicQuery(topic_));
    for (const rosbag::MessageInstance& message : view_) messages_.push_back(message);
  } catch (const ros::Exception& fault) {
    throw Error(fmt::format("{}: the bag's index cannot be read ({}); repair it with: rosbag reindex {}",
                            file_, fault.what(), file_));
  }
  if (messages_.empty()) throw Error(fmt::format("{} has no message on topic {}", file_, topic_));
}

MessageBytes PictureTopic::bytes(std::size_t message) {
  try {
    bytes_.resize(messages_[message].size());
    ros::serialization::OStream out(bytes_.data(), static_cast<std::uint32_t>(bytes_.size()));
    messages_[message].write(out);
  } catch (const std::exception& fault) {
    throw fault_in(message, fmt::format("it cannot be read ({})", fault.what()));
  }
  return bytes_;
}

Error PictureTopic::fault_in(std::size_t message, std::string_view sentence) const {
  return Error(fmt::format("{}: message {} of {}: {}", file_, message, topic_, sentence));
}

}  // namespace relock
