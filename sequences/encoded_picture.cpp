#include "sequences/encoded_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>

#include "core/error.h"

namespace relock {
namespace {

/// libjpeg fills what is missing with grey and says nothing that can be asked: the end marker tells.
bool is_cut_off_jpeg(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < 4 || bytes[0] != 0xFF || bytes[1] != 0xD8) return false;
  const std::size_t tail = std::min<std::size_t>(bytes.size(), 1024);  // cameras pad behind the marker
  for (std::size_t i = bytes.size() - tail; i + 1 < bytes.size(); ++i)
    if (bytes[i] == 0xFF && bytes[i + 1] == 0xD9) return false;
  return true;
}

}  // namespace

cv::Mat decode_picture(std::span<const std::uint8_t> bytes) {
  if (bytes.empty() || is_cut_off_jpeg(bytes))
    throw Error(fmt::format("this picture is cut off after {} bytes", bytes.size()));
  // Into a new buffer: into one that it may reuse, OpenCV answers a picture that it cannot decode with what was
  // in there before.
  cv::Mat decoded;
  try {
    // A Mat has no const elements; these are not written to.
    const cv::Mat file(1, static_cast<int>(bytes.size()), CV_8UC1, const_cast<std::uint8_t*>(bytes.data()));
    decoded = cv::imdecode(file, cv::IMREAD_ANYCOLOR | cv::IMREAD_ANYDEPTH);
  } catch (const cv::Exception&) {
    decoded.release();
  }
  if (decoded.empty()) throw Error("this is no picture that can be read");
  if (decoded.depth() == CV_16U) decoded.convertTo(decoded, CV_8U, 1. / 257);
  if (decoded.depth() != CV_8U)
    throw Error("this picture's pixels are neither of 8 nor of 16 bits; relock reads no others");
  return decoded;
}

}  // namespace relock
