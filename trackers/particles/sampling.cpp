#include "trackers/particles/sampling.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/opencv.h"

namespace relock::particles {
namespace {

constexpr double kPixelsPerSample = 1.6;
constexpr float kLeastContrast = 1e-3F;  // standard deviation, of grey values in [0, 1]
constexpr double kBeyondBorder = 0.3;    // of the width: how far outside a target's centre may be

/// Between the four pixels around (x, y), which is in the picture.
inline float bilinear(const cv::Mat1f& picture, float x, float y) {
  const int column = static_cast<int>(x), row = static_cast<int>(y);
  const float right = x - static_cast<float>(column), below = y - static_cast<float>(row);
  const float* const upper = picture.ptr<float>(row) + column;
  const float* const lower = picture.ptr<float>(row + 1) + column;
  const float top = upper[0] + right * (upper[1] - upper[0]);
  const float bottom = lower[0] + right * (lower[1] - lower[0]);
  return top + below * (bottom - top);
}

}  // namespace

void Sampling::show(const Image& picture, double scale) {
  size_ = picture.size();
  const cv::Mat gray = gray_of(picture, gray_);
  shrink_x_ = std::min(1.0, kPixelsPerSample * grid_.columns / (start_.x * scale));
  shrink_y_ = std::min(1.0, kPixelsPerSample * grid_.rows / (start_.y * scale));
  // At least two pixels a side, so that there is something to interpolate.
  shrink_x_ = std::max(shrink_x_, std::min(1.0, 2.0 / size_.width));
  shrink_y_ = std::max(shrink_y_, std::min(1.0, 2.0 / size_.height));
  cv::resize(gray, small_, {}, shrink_x_, shrink_y_, cv::INTER_AREA);
  small_.convertTo(shrunk_, CV_32F, 1 / 255.0);
}

void Sampling::read(const State& state, Eigen::Ref<Eigen::VectorXf> values) const {
  const auto in_shrunk = [&](Vec2 v) { return Vec2{v.x * shrink_x_, v.y * shrink_y_}; };
  const Vec2 column_step = in_shrunk(carried(state, {start_.x / grid_.columns, 0}));
  const Vec2 row_step = in_shrunk(carried(state, {0, start_.y / grid_.rows}));
  const Vec2 half{0.5, 0.5};
  const Vec2 middle = in_shrunk(state.centre + half) - half;
  const Vec2 first = middle - (0.5 * (grid_.columns - 1)) * column_step - (0.5 * (grid_.rows - 1)) * row_step;
  // Up to just before the last pixel, so that there is always one to the right and one below.
  const float right_end = static_cast<float>(shrunk_.cols - 1) - 1e-3F;
  const float lower_end = static_cast<float>(shrunk_.rows - 1) - 1e-3F;
  const auto step_x = static_cast<float>(column_step.x), step_y = static_cast<float>(column_step.y);
  float* value = values.data();
  for (int row = 0; row < grid_.rows; ++row) {
    const Vec2 begin = first + static_cast<double>(row) * row_step;
    const auto x = static_cast<float>(begin.x), y = static_cast<float>(begin.y);
    for (int column = 0; column < grid_.columns; ++column) {
      const auto steps = static_cast<float>(column);
      *value++ = bilinear(shrunk_, std::clamp(x + steps * step_x, 0.0F, right_end),
                          std::clamp(y + steps * step_y, 0.0F, lower_end));
    }
  }
}

void Sampling::observe(std::span<const State> states, Observations& observations) const {
  const auto count = static_cast<Eigen::Index>(states.size());
  observations.look.resize(grid_.size(), count);
  observations.usable.resize(states.size());
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    auto look = observations.look.col(i);
    observations.usable[at] = near_picture(states[at]);
    if (!observations.usable[at]) {
      look.setZero();
      continue;
    }
    read(states[at], look);
    observations.usable[at] = whiten(look);
  }
}

bool Sampling::near_picture(const State& state) const {
  const double beyond = kBeyondBorder * start_.x * state.scale;
  const Vec2 c = state.centre;
  return c.x > -beyond && c.y > -beyond && c.x < size_.width + beyond && c.y < size_.height + beyond;
}

bool whiten(Eigen::Ref<Eigen::VectorXf> values) {
  values.array() -= values.mean();
  const float length = values.norm();
  if (!(length > kLeastContrast * std::sqrt(static_cast<float>(values.size())))) {
    values.setZero();
    return false;
  }
  values /= length;
  return true;
}

}  // namespace relock::particles
