#include "cli/labelling/shelf.h"

#include <fmt/format.h>

#include "core/error.h"
#include "core/opencv.h"

namespace relock {
namespace {

constexpr std::size_t kMostBytes = 256u << 20;
constexpr std::size_t kOnTheWay = 24;  // pictures before the one asked for, that a step back will want

std::size_t bytes_of(const cv::Mat& mat) { return mat.total() * mat.elemSize(); }

}  // namespace

const cv::Mat& PictureShelf::picture(std::size_t frame) {
  if (const cv::Mat* there = kept(frame)) return *there;
  if (!source_ || frame < next_) {
    source_ = open_();
    next_ = 0;
  }
  while (next_ <= frame) {
    if (!source_->next()) throw Error(fmt::format("frame {} cannot be read", frame));
    if (next_ + kOnTheWay >= frame) keep(next_, read_only_mat(source_->image()));
    ++next_;
  }
  return shelf_.back().pixels;
}

const cv::Mat* PictureShelf::kept(std::size_t frame) const {
  for (const Kept& each : shelf_)
    if (each.frame == frame) return &each.pixels;
  return nullptr;
}

void PictureShelf::keep(std::size_t frame, const cv::Mat& pixels) {
  std::erase_if(shelf_, [&](const Kept& each) {
    if (each.frame != frame) return false;
    bytes_ -= bytes_of(each.pixels);
    return true;
  });
  shelf_.push_back({frame, pixels.clone()});
  bytes_ += bytes_of(pixels);
  while (bytes_ > kMostBytes && shelf_.size() > kOnTheWay + 1) {
    bytes_ -= bytes_of(shelf_.front().pixels);
    shelf_.pop_front();
  }
}

}  // namespace relock
