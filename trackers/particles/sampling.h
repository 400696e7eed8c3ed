#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

#include "core/image.h"
#include "trackers/particles/state.h"

namespace relock::particles {

/// Samples of a target's look: `columns` by `rows` of them, evenly over its box.
struct Grid {
  int columns = 20;
  int rows = 20;
  int size() const { return columns * rows; }
};

/// What particles see: a column each, of mean 0 and length 1.
struct Observations {
  Eigen::MatrixXf look;
  /// Whether the column is one: the centre is in or near the picture, and there is contrast. Else it is 0.
  std::vector<std::uint8_t> usable;
};

/// Reads targets off a picture, on a grid that moves, scales and turns with the state: grey, bilinear.
///
/// The picture is shrunk first, to about 1.6 pixels a sample, by averaging areas: without, a target of 100 px on a
/// grid of 20 would be read at every fifth pixel, and its look would change with every pixel that it moves.
class Sampling {
 public:
  /// `start`: width and height of the start box, px.
  Sampling(Grid grid, Vec2 start) : grid_(grid), start_(start) {}

  /// The picture that is read next, for targets of about this scale. Its pixels are copied.
  void show(const Image& picture, double scale);

  /// The grey values in [0, 1] at `state`, row by row; beyond the picture those of its border.
  void read(const State& state, Eigen::Ref<Eigen::VectorXf> values) const;

  /// What each state sees, whitened.
  void observe(std::span<const State> states, Observations& observations) const;

  const Grid& grid() const { return grid_; }

 private:
  bool near_picture(const State& state) const;

  Grid grid_;
  Vec2 start_;
  Size size_;  // of the picture as it was shown
  cv::Mat gray_, small_;
  cv::Mat1f shrunk_;
  double shrink_x_ = 1, shrink_y_ = 1;
};

/// Makes the mean 0 and the length 1. False, and all 0, when the values have no contrast.
bool whiten(Eigen::Ref<Eigen::VectorXf> values);

}  // namespace relock::particles
