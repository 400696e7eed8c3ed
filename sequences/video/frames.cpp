#include "sequences/video/frames.h"

#include <fmt/format.h>

#include "core/error.h"
#include "sequences/video/decoder.h"
#include "sequences/video/picture.h"

namespace relock {
namespace {

class VideoFrames final : public FrameSource {
 public:
  VideoFrames(const std::filesystem::path& path, std::shared_ptr<const VideoIndex> index)
      : index_(std::move(index)),
        decoder_(path),
        maker_(decoder_.file().turn()),
        size_(decoder_.file().picture_size()) {
    decoded_ = decoder_.next();
    ended_ = !decoded_;
    // What the container says of the size may be that of later pictures.
    if (decoded_) size_ = turned(decoded_->stored, decoder_.file().turn());
  }

  std::span<const Time> captured() const override { return index_->captured; }
  Size picture_size() const override { return size_; }

  std::optional<FrameStamp> next() override {
    if (next_ >= index_->captured.size()) return {};
    const std::size_t rank = next_++;
    made_ = false;
    return FrameStamp{static_cast<FrameIndex>(rank), index_->captured[rank]};
  }

  Image image() override {
    if (!made_) make();
    return image_;
  }

 private:
  std::size_t rank() const { return next_ - 1; }

  /// The frame's key as the index has it.
  std::int64_t key(const DecodedFrame& frame) const {
    return index_->by_rank ? frame.rank : frame.ticks.value_or(0);
  }

  void make() {
    const std::int64_t wanted = index_->keys[rank()];
    while (!ended_ && (!decoded_ || key(*decoded_) < wanted)) {
      decoded_ = decoder_.next();
      ended_ = !decoded_;
    }
    const bool there = decoded_ && key(*decoded_) == wanted;
    if (!there && index_->cut_off && rank() + 1 == index_->keys.size()) fail("the file is cut off here");
    if (!there) fail("this frame cannot be decoded");
    if (!decoded_->whole) fail("this frame is damaged, or one that it is made from");
    try {
      image_ = maker_.picture(*decoded_->frame);
    } catch (const Error& fault) {
      fail(fault.what());
    }
    if (image_.size().width != size_.width || image_.size().height != size_.height)
      fail(fmt::format("this picture is {}x{} and those before it {}x{}; all must be of one size",
                       image_.size().width, image_.size().height, size_.width, size_.height));
    made_ = true;
  }

  [[noreturn]] void fail(std::string_view what) const {
    throw Error(fmt::format("{}: frame {} at {:.6f} s: {}", decoder_.file().name(), rank(),
                            seconds(index_->captured[rank()]), what));
  }

  std::shared_ptr<const VideoIndex> index_;
  VideoDecoder decoder_;
  PictureMaker maker_;
  Size size_;
  std::size_t next_ = 0;
  std::optional<DecodedFrame> decoded_;
  bool ended_ = false;
  bool made_ = false;
  Image image_;
};

}  // namespace

std::unique_ptr<FrameSource> open_video(const std::filesystem::path& path,
                                        std::shared_ptr<const VideoIndex> index) {
  return std::make_unique<VideoFrames>(path, std::move(index));
}

}  // namespace relock
