#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "core/image.h"

namespace cv {
class Mat;
}

namespace relock {

/// A picture that owns its pixels: row after row from the top, without gaps.
struct Picture {
  Size size;
  PixelFormat format = PixelFormat::gray8;
  std::vector<std::uint8_t> pixels;

  Picture() = default;
  /// A copy of what the view shows.
  Picture(const Image& image) : size(image.size()), format(image.format()) {
    if (image.empty()) return;
    const std::size_t row = static_cast<std::size_t>(size.width) * static_cast<std::size_t>(channels(format));
    pixels.resize(row * static_cast<std::size_t>(size.height));
    for (int y = 0; y < size.height; ++y)
      std::memcpy(pixels.data() + row * static_cast<std::size_t>(y), image.row(y), row);
  }
  /// A copy of a picture of OpenCV's of type CV_8UC1 or CV_8UC3, for who includes core/opencv.h. Throws Error
  /// on another type.
  Picture(const cv::Mat& mat);

  /// Valid as long as this picture is there and its pixels are not changed.
  Image view() const {
    if (pixels.empty()) return {};
    return Image(pixels.data(), size, format,
                 static_cast<std::size_t>(size.width) * static_cast<std::size_t>(channels(format)));
  }
};

}  // namespace relock
