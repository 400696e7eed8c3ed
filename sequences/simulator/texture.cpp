#include "sequences/simulator/texture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "core/display_coding.h"

namespace relock::simulator {
namespace {

const std::array<float, 256>& linear_of_byte() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> made{};
    for (std::size_t i = 0; i < made.size(); ++i)
      made[i] = static_cast<float>(light_of_coded(static_cast<double>(i) / 255));
    return made;
  }();
  return table;
}

// One row of the picture with `channels` bytes a pixel; `light` is null where there is none.
void linear_row(const uchar* bytes, int channels, const float* light, int width, cv::Vec4f* out) {
  const std::array<float, 256>& linear = linear_of_byte();
  for (int x = 0; x < width; ++x, bytes += channels) {
    const int green = channels == 1 ? 0 : 1;
    const float coverage = channels == 4 ? static_cast<float>(bytes[3]) / 255.0f : 1.0f;
    const float factor = coverage * (light ? light[x] : 1.0f);
    out[x] = {factor * linear[bytes[0]], factor * linear[bytes[green]], factor * linear[bytes[2 * green]],
              coverage};
  }
}

}  // namespace

Texture make_texture(const cv::Mat& picture, const cv::Mat& light) {
  const int channels = picture.channels();
  if (picture.empty() || picture.depth() != CV_8U || channels == 2 || channels > 4)
    throw std::invalid_argument("a texture is made of a picture of 1, 3 or 4 channels of 8 bits");
  cv::Mat stretched;
  if (!light.empty()) cv::resize(light, stretched, picture.size(), 0, 0, cv::INTER_LINEAR);

  Texture texture{{cv::Mat(picture.size(), CV_32FC4)}};
  cv::Mat& full = texture.levels.front();
  for (int y = 0; y < full.rows; ++y)
    linear_row(picture.ptr(y), channels, stretched.empty() ? nullptr : stretched.ptr<float>(y), full.cols,
               full.ptr<cv::Vec4f>(y));

  // Where a size is odd the areas share texels in part, so that every level is stretched over the same
  // rectangle and none loses its last row.
  while (std::min(texture.levels.back().cols, texture.levels.back().rows) > 1) {
    const cv::Mat& finer = texture.levels.back();
    cv::Mat coarser;
    cv::resize(finer, coarser, {finer.cols / 2, finer.rows / 2}, 0, 0, cv::INTER_AREA);
    texture.levels.push_back(coarser);
  }
  return texture;
}

}  // namespace relock::simulator
