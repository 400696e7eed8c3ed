#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <opencv2/core/mat.hpp>

#include "core/frame_source.h"

namespace relock {

/// A recording's pictures in any order, though they can only be read from the first on: those read last are kept, so
/// that steps to and fro cost nothing; farther back means reading anew. One thread at a time.
class PictureShelf {
 public:
  explicit PictureShelf(std::function<std::unique_ptr<FrameSource>()> open) : open_(std::move(open)) {}

  /// Valid until the next call. Throws Error when it cannot be read.
  const cv::Mat& picture(std::size_t frame);

 private:
  struct Kept {
    std::size_t frame;
    cv::Mat pixels;
  };
  const cv::Mat* kept(std::size_t frame) const;
  void keep(std::size_t frame, const cv::Mat& pixels);

  std::function<std::unique_ptr<FrameSource>()> open_;
  std::unique_ptr<FrameSource> source_;
  std::size_t next_ = 0;  // of source_
  std::deque<Kept> shelf_;
  std::size_t bytes_ = 0;
};

}  // namespace relock
