#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

namespace relock::simulator {

/// Coded (sRGB) blue, green and red of a matt paint that throws back these shares of the light.
cv::Scalar paint(double red, double green, double blue);
inline cv::Scalar paint(double gray) { return paint(gray, gray, gray); }

/// Part of a flat thing being painted: everything is drawn in metres from the thing's own top left corner, so
/// that a finer picture of a part shows the same as a coarser one of the whole.
struct Canvas {
  cv::Rect2d area;  ///< m
  cv::Mat picture;  ///< CV_8UC3, stretched over the area

  /// With about `texels_per_m`, black.
  Canvas(const cv::Rect2d& area, double texels_per_m);
  /// On a picture that is there already; it may be CV_8UC1, and colours then are grey levels.
  Canvas(const cv::Rect2d& area, const cv::Mat& picture);

  cv::Point2d pixel(const cv::Point2d& place) const;
  double texels_per_m() const { return picture.cols / area.width; }

  void fill(const cv::Rect2d& rectangle, const cv::Scalar& colour);
  void fill(const std::vector<cv::Point2d>& polygon, const cv::Scalar& colour);
  void disc(const cv::Point2d& middle, double radius, const cv::Scalar& colour);
  void circle(const cv::Point2d& middle, double radius, double width, const cv::Scalar& colour);
  /// `half`: the half axes, the first of them turned by `turn` (rad, from x towards y).
  void ellipse(const cv::Point2d& middle, const cv::Size2d& half, double turn, const cv::Scalar& colour);
  void line(const cv::Point2d& from, const cv::Point2d& to, double width, const cv::Scalar& colour);
  /// `height`: of a capital letter; `start`: left end of the base line.
  void write(const std::string& text, const cv::Point2d& start, double height, const cv::Scalar& colour);
};

}  // namespace relock::simulator
