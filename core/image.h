#pragma once

#include <cstddef>
#include <cstdint>

#include "core/geometry.h"

namespace relock {

enum class PixelFormat : std::uint8_t {
  gray8,  ///< one byte a pixel
  bgr8,   ///< three bytes a pixel: blue, green, red
};
constexpr int channels(PixelFormat format) { return format == PixelFormat::gray8 ? 1 : 3; }

/// A read-only view of a picture's pixels, row by row from the top. It owns nothing: whoever made it says how
/// long the pixels live. (A `const cv::Mat&` does not protect its pixels, and library trackers do write into
/// what they are given.)
class Image {
 public:
  Image() = default;
  /// `stride`: bytes from one row to the next.
  Image(const std::uint8_t* data, Size size, PixelFormat format, std::size_t stride)
      : data_(data), size_(size), format_(format), stride_(stride) {}

  bool empty() const { return data_ == nullptr || size_.width <= 0 || size_.height <= 0; }
  Size size() const { return size_; }
  PixelFormat format() const { return format_; }
  std::size_t stride() const { return stride_; }
  /// First byte of row `y`.
  const std::uint8_t* row(int y) const { return data_ + static_cast<std::size_t>(y) * stride_; }

 private:
  const std::uint8_t* data_ = nullptr;
  Size size_;
  PixelFormat format_ = PixelFormat::gray8;
  std::size_t stride_ = 0;
};

}  // namespace relock
