#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/geometry.h"

namespace relock::ring {

/// Which way parallel lines run across a picture: one pixel along `axis` a step, and `slope` pixels across it.
struct LineDirection {
  enum class Axis : std::uint8_t { x, y };
  Axis axis = Axis::x;
  double slope = 0;

  /// From one step to the next, px.
  Vec2 step() const { return axis == Axis::x ? Vec2{1, slope} : Vec2{slope, 1}; }
};

/// Eight directions, 22.5 degrees apart. Shearing the rows (or the columns) of a picture makes each family of
/// lines out of one linear interpolation with the same fraction for a whole row.
inline constexpr double kTangentOf22Degrees = 0.41421356237309503;
inline constexpr std::array<LineDirection, 8> kLineDirections = {{
    {LineDirection::Axis::x, 0},
    {LineDirection::Axis::x, kTangentOf22Degrees},
    {LineDirection::Axis::y, 1},
    {LineDirection::Axis::y, kTangentOf22Degrees},
    {LineDirection::Axis::y, 0},
    {LineDirection::Axis::y, -kTangentOf22Degrees},
    {LineDirection::Axis::x, -1},
    {LineDirection::Axis::x, -kTangentOf22Degrees},
}};

/// Grey values at equal steps along a straight line, each interpolated between its two neighbours across it.
struct Line {
  const std::uint8_t* values = nullptr;
  int steps = 0;
  Vec2 start;  ///< where values[0] is, px
  Vec2 step;   ///< px

  Vec2 at(double steps_from_start) const { return start + steps_from_start * step; }
};

/// All lines of one direction across a picture, two pixels apart across their axis. Buffers are kept.
class LineScan {
 public:
  static constexpr int kSpacing = 2;

  /// `transposed`: the picture with x and y exchanged; only looked at for sloped lines along x. Lines are valid
  /// until the next call and as long as the picture.
  void read(const cv::Mat& picture, const cv::Mat& transposed, LineDirection direction);

  std::size_t size() const { return count_; }
  Line operator[](std::size_t rank) const;

 private:
  void shear(const cv::Mat& rows_are_steps);

  LineDirection direction_;
  std::size_t count_ = 0;
  cv::Mat rows_;             // lines along x without slope are the picture's rows
  double first_ = 0;         // where line 0 begins across the axis, px
  int width_ = 0;            // of the picture across the axis
  int steps_ = 0;            // along it
  cv::Mat sheared_, lines_;  // rows are steps; rows are lines
};

/// Where a line's grey values change most, in order.
struct Edges {
  std::vector<float> at;    ///< steps from the line's start, between steps by a parabola
  std::vector<float> rise;  ///< grey levels over two steps; negative where they fall
  void clear() {
    at.clear();
    rise.clear();
  }
  std::size_t size() const { return at.size(); }
};

/// Finds the edges of single lines. Buffers are kept.
class EdgeFinder {
 public:
  /// Edges whose grey levels change by more than `least_rise` over two steps; valid until the next call.
  const Edges& find(const Line& line, int least_rise);

 private:
  std::vector<std::int16_t> rise_;
  std::vector<std::uint8_t> is_edge_;
  std::vector<std::int32_t> places_;
  Edges edges_;
};

}  // namespace relock::ring
