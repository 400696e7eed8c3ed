#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <numeric>

#include "core/error.h"
#include "core/opencv.h"
#include "sequences/rosbag.h"
#include "sequences/rosbag/bag.h"
#include "sequences/sidecars.h"

namespace relock {
namespace {

namespace fs = std::filesystem;

/// What one pass over a bag finds out for all others.
struct BagIndex {
  fs::path file;
  std::string topic;
  std::vector<std::size_t> messages;  // of each frame
  std::vector<Time> captured;
};

class BagFrames final : public FrameSource {
 public:
  explicit BagFrames(std::shared_ptr<const BagIndex> index)
      : index_(std::move(index)), topic_(index_->file, index_->topic) {
    const cv::Mat first = decoded(0);
    size_ = {first.cols, first.rows};
  }

  std::span<const Time> captured() const override { return index_->captured; }
  Size picture_size() const override { return size_; }

  std::optional<FrameStamp> next() override {
    if (next_ >= index_->captured.size()) return {};
    const std::size_t rank = next_++;
    return FrameStamp{static_cast<FrameIndex>(rank), index_->captured[rank]};
  }

  Image image() override {
    const cv::Mat picture = decoded(next_ - 1);
    if (picture.cols != size_.width || picture.rows != size_.height)
      throw topic_.fault_in(
          index_->messages[next_ - 1],
          fmt::format("this picture is {}x{} and the first one {}x{}; all must be of one size", picture.cols,
                      picture.rows, size_.width, size_.height));
    return view(picture);
  }

 private:
  cv::Mat decoded(std::size_t rank) {
    const std::size_t message = index_->messages[rank];
    const MessageBytes bytes = topic_.bytes(message);
    try {
      return pixels_of(bytes, topic_.type(message), buffer_);
    } catch (const Error& fault) {
      throw topic_.fault_in(message, fault.what());
    }
  }

  std::shared_ptr<const BagIndex> index_;
  PictureTopic topic_;
  Size size_;
  std::size_t next_ = 0;
  cv::Mat buffer_;
};

void check_clock(const BagIndex& index, const std::vector<Time>& stamps) {
  constexpr Duration kMostDisorder = std::chrono::seconds(1);  // transport reorders by less
  Time latest = stamps.front();
  for (std::size_t i = 1; i < stamps.size(); ++i) {
    if (latest - stamps[i] > kMostDisorder)
      throw Error(
          fmt::format("{}: the header stamp of message {} of {} ({} ns) goes back by {:.3f} s; was the "
                      "camera's clock set here?",
                      index.file.string(), i, index.topic, ns(stamps[i]), seconds(latest - stamps[i])));
    latest = std::max(latest, stamps[i]);
  }
  for (std::size_t i = 1; i < index.captured.size(); ++i)
    if (index.captured[i] == index.captured[i - 1])
      throw Error(fmt::format(
          "{}: messages {} and {} of {} have the same header stamp ({} ns); capture times must rise",
          index.file.string(), index.messages[i - 1], index.messages[i], index.topic, ns(index.captured[i])));
}

BagIndex index_bag(const fs::path& path, const std::optional<std::string>& topic,
                   const fs::path& timestamps) {
  PictureTopic pictures(path, topic);
  BagIndex index{path, pictures.topic(), std::vector<std::size_t>(pictures.messages()), {}};
  std::iota(index.messages.begin(), index.messages.end(), std::size_t{0});
  if (fs::exists(timestamps)) {
    index.captured = sidecar_times(timestamps, pictures.messages(), path.string());
    return index;
  }
  std::vector<Time> stamps;
  for (const std::size_t message : index.messages) stamps.push_back(stamp_of(pictures.bytes(message)));
  std::stable_sort(index.messages.begin(), index.messages.end(),
                   [&](std::size_t a, std::size_t b) { return stamps[a] < stamps[b]; });
  for (const std::size_t message : index.messages) index.captured.push_back(stamps[message]);
  check_clock(index, stamps);
  return index;
}

}  // namespace

bool recognises_rosbag(const fs::path& path) { return path.extension() == ".bag" && !fs::is_directory(path); }

FoundRecording find_rosbag(const fs::path& path, const OpenOptions& options) {
  const Sidecars sidecars = sidecars_beside(path);
  FoundRecording found;
  found.description = read_description(sidecars.description, sidecars.name);
  found.labels = sidecars.labels;
  found.data = {path};
  const auto index = std::make_shared<const BagIndex>(index_bag(path, options.topic, sidecars.timestamps));
  found.frames = [index] { return std::make_unique<BagFrames>(index); };
  return found;
}

}  // namespace relock
