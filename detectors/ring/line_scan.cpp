#include "detectors/ring/line_scan.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <opencv2/core.hpp>

#include "detectors/ring/vector_clones.h"

namespace relock::ring {
namespace {

constexpr int kOne = 256;  // of the fixed-point fraction between two pixels

/// out[i] = between pixels 2i and 2i + 1, `fraction` / 256 of the way.
RELOCK_VECTOR_CLONES void every_second(const std::uint8_t* pixels, int fraction, int count,
                                       std::uint8_t* out) {
  const auto near = static_cast<std::uint16_t>(kOne - fraction), far = static_cast<std::uint16_t>(fraction);
  for (int i = 0; i < count; ++i) {
    const auto sum = static_cast<std::uint16_t>(pixels[2 * i] * near + pixels[2 * i + 1] * far + kOne / 2);
    out[i] = static_cast<std::uint8_t>(sum >> 8);
  }
}

/// rise[i] = values[i + 1] - values[i - 1], 0 at the ends.
RELOCK_VECTOR_CLONES void differences(const std::uint8_t* values, int count, std::int16_t* rise) {
  rise[0] = rise[count - 1] = 0;
  for (int i = 1; i + 1 < count; ++i) rise[i] = static_cast<std::int16_t>(values[i + 1] - values[i - 1]);
}

/// Of several equal in a row the last one is the edge: the parabola through it then gives the middle of two.
RELOCK_VECTOR_CLONES void steepest(const std::int16_t* rise, int count, std::int16_t least,
                                   std::uint8_t* is_edge) {
  const auto most = static_cast<std::int16_t>(-least);
  is_edge[0] = is_edge[count - 1] = 0;
  for (int i = 1; i + 1 < count; ++i) {
    const std::int16_t before = rise[i - 1], here = rise[i], after = rise[i + 1];
    const bool up = (here > least) & (here >= before) & (here > after);
    const bool down = (here < most) & (here <= before) & (here < after);
    is_edge[i] = static_cast<std::uint8_t>(up | down);
  }
}

/// Where the parabola through three neighbouring values has its vertex, from the middle one.
float vertex(float before, float here, float after) {
  const float curvature = 2 * here - before - after;
  return curvature == 0 ? 0 : 0.5F * (after - before) / curvature;
}

}  // namespace

void LineScan::read(const cv::Mat& picture, const cv::Mat& transposed, LineDirection direction) {
  direction_ = direction;
  const bool along_x = direction.axis == LineDirection::Axis::x;
  width_ = along_x ? picture.rows : picture.cols;
  steps_ = along_x ? picture.cols : picture.rows;
  count_ = 0;
  if (width_ < 2 || steps_ < 2) return;
  const double across = direction.slope * (steps_ - 1);
  first_ = std::min(0.0, -across);
  count_ = static_cast<std::size_t>((width_ - 1 + std::abs(across)) / kSpacing) + 1;
  if (along_x && direction.slope == 0) {
    rows_ = picture;
    count_ = static_cast<std::size_t>((width_ - 1) / kSpacing) + 1;
  } else {
    shear(along_x ? transposed : picture);
  }
}

void LineScan::shear(const cv::Mat& rows_are_steps) {
  const int count = static_cast<int>(count_);
  sheared_.create(steps_, count, CV_8UC1);
  for (int step = 0; step < steps_; ++step) {
    const double begin = first_ + direction_.slope * step;  // of line 0, px
    const int line = std::max(0, static_cast<int>(std::ceil(-begin / kSpacing)));
    const double x = begin + kSpacing * line;
    const int left = static_cast<int>(x);
    const int end = std::min(count, line + (width_ - left) / kSpacing);
    const int fraction = static_cast<int>((x - left) * kOne);
    if (end > line)
      every_second(rows_are_steps.ptr(step) + left, fraction, end - line, sheared_.ptr(step) + line);
  }
  cv::transpose(sheared_, lines_);
}

Line LineScan::operator[](std::size_t rank) const {
  const double begin = first_ + kSpacing * static_cast<double>(rank);
  const bool along_x = direction_.axis == LineDirection::Axis::x;
  const auto place = [&](double along, double across) {
    return along_x ? Vec2{along, across} : Vec2{across, along};
  };
  if (along_x && direction_.slope == 0)
    return {rows_.ptr(kSpacing * static_cast<int>(rank)), steps_, place(0, begin), direction_.step()};
  // The steps at which the line lies between two pixels of the picture: 0 <= begin + slope step < width - 1.
  const double slope = direction_.slope;
  double low = 0, high = steps_ - 1;
  if (slope > 0) {
    low = std::max(low, std::ceil(-begin / slope));
    high = std::min(high, std::ceil((width_ - 1 - begin) / slope) - 1);
  } else if (slope < 0) {
    low = std::max(low, std::floor((width_ - 1 - begin) / slope) + 1);
    high = std::min(high, std::floor(-begin / slope));
  } else if (begin >= width_ - 1) {
    high = -1;
  }
  if (high < low) return {};
  const int from = static_cast<int>(low);
  return {lines_.ptr(static_cast<int>(rank)) + from, static_cast<int>(high) - from + 1,
          place(low, begin + slope * low), direction_.step()};
}

const Edges& EdgeFinder::find(const Line& line, int least_rise) {
  edges_.clear();
  if (line.steps < 3) return edges_;
  const auto count = static_cast<std::size_t>(line.steps);
  constexpr std::size_t kWord = sizeof(std::uint64_t);
  if (rise_.size() < count + kWord) {
    rise_.resize(count + kWord);
    is_edge_.resize(count + kWord);
    places_.resize(count + kWord);
  }
  differences(line.values, line.steps, rise_.data());
  steepest(rise_.data(), line.steps, static_cast<std::int16_t>(least_rise), is_edge_.data());
  std::fill_n(is_edge_.begin() + line.steps, kWord, std::uint8_t{0});
  std::size_t found = 0;
  for (std::size_t word = 0; word < count; word += kWord) {
    std::uint64_t any = 0;
    std::memcpy(&any, is_edge_.data() + word, kWord);
    if (any == 0) continue;
    for (std::size_t i = word; i < word + kWord; ++i) {
      places_[found] = static_cast<std::int32_t>(i);
      found += is_edge_[i];
    }
  }
  edges_.at.resize(found);
  edges_.rise.resize(found);
  for (std::size_t i = 0; i < found; ++i) {
    const auto place = static_cast<std::size_t>(places_[i]);
    const float here = rise_[place];
    edges_.at[i] = static_cast<float>(place) + vertex(rise_[place - 1], here, rise_[place + 1]);
    edges_.rise[i] = here;
  }
  return edges_;
}

}  // namespace relock::ring
