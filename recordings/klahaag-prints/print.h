// A marker printed on a white board, drawn into a picture as a camera would have seen it.
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace recordings {

/// Corners of the marker's black border: top-left, top-right, bottom-right, bottom-left of the upright
/// marker.
using Quad = std::array<cv::Point2d, 4>;

/// The cells inside the black border's outer edge, 0 = black, 255 = white, one element a cell.
cv::Mat1b aruco6x6_250_cells(int id);
cv::Mat1b apriltag36h11_cells(int id);

/// A map of the unit square (the black border's outer edge) to the picture, px.
using Pose = cv::Matx33d;
Pose pose_of(const Quad& outline);
cv::Point2d project(const Pose& pose, const cv::Point2d& on_print);
Quad outline_of(const Pose& pose);

/// Noise of a sensor from integers only, so that it is the same everywhere.
class Noise {
 public:
  explicit Noise(std::uint64_t seed) : state_(seed) {}
  /// Mean 0, standard deviation 1, nearly normal: a sum of twelve uniform numbers.
  double normal();

 private:
  std::uint64_t state_;
};

/// What the board is made of and what the camera does to it.
struct Look {
  double margin_cells = 1.25;      ///< white board around the black border
  cv::Vec3d black{37, 34, 35};     ///< BGR of the ink, where the light is the mean around the board
  cv::Vec3d white{193, 196, 199};  ///< and of the paper
  double local_light = 0.25;       ///< how much the light follows the scene around the board
  double lens_blur_px = 0.7;       ///< standard deviation of the optical blur
  double noise = 1.5;              ///< grey levels, one sigma
  cv::Point2d shadow{2.5, 3.5};    ///< px; the board's shadow on what is behind it
  double shadow_depth = 0.45;      ///< 0 none, 1 black
};

/// Draws the print into `picture`. `exposure` holds the poses at the middles of equal parts of the exposure.
void draw_print(cv::Mat3b& picture, const cv::Mat1b& cells, const std::vector<Pose>& exposure,
                const Look& look, Noise& noise);

}  // namespace recordings
