#include "sequences/simulator/painting.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/display_coding.h"

#include "sequences/simulator/texture.h"

namespace relock::simulator {
namespace {

constexpr int kShift = 4;  // OpenCV draws at sixteenths of a pixel

cv::Point fine(const cv::Point2d& pixel) {
  return {static_cast<int>(std::lround(pixel.x * (1 << kShift))),
          static_cast<int>(std::lround(pixel.y * (1 << kShift)))};
}

double coded(double share) { return 255 * coded_of_light(std::clamp(share, 0.0, 1.0)); }

int whole(double length) { return std::max(1, static_cast<int>(std::lround(length))); }

}  // namespace

cv::Scalar paint(double red, double green, double blue) { return {coded(blue), coded(green), coded(red)}; }

Canvas::Canvas(const cv::Rect2d& area_, double texels_per_m)
    : area(area_),
      picture(whole(area_.height * texels_per_m), whole(area_.width * texels_per_m), CV_8UC3, cv::Scalar(0)) {
}

Canvas::Canvas(const cv::Rect2d& area_, const cv::Mat& picture_) : area(area_), picture(picture_) {}

cv::Point2d Canvas::pixel(const cv::Point2d& place) const {
  return {(place.x - area.x) * picture.cols / area.width - 0.5,
          (place.y - area.y) * picture.rows / area.height - 0.5};
}

void Canvas::fill(const cv::Rect2d& r, const cv::Scalar& colour) {
  fill({{r.x, r.y}, {r.x + r.width, r.y}, {r.x + r.width, r.y + r.height}, {r.x, r.y + r.height}}, colour);
}

void Canvas::fill(const std::vector<cv::Point2d>& polygon, const cv::Scalar& colour) {
  std::vector<cv::Point> corners;
  for (const cv::Point2d& corner : polygon) corners.push_back(fine(pixel(corner)));
  cv::fillConvexPoly(picture, corners, colour, cv::LINE_AA, kShift);
}

void Canvas::disc(const cv::Point2d& middle, double radius, const cv::Scalar& colour) {
  const int fine_radius = static_cast<int>(std::lround(radius * texels_per_m() * (1 << kShift)));
  cv::circle(picture, fine(pixel(middle)), fine_radius, colour, cv::FILLED, cv::LINE_AA, kShift);
}

void Canvas::circle(const cv::Point2d& middle, double radius, double width, const cv::Scalar& colour) {
  const int fine_radius = static_cast<int>(std::lround(radius * texels_per_m() * (1 << kShift)));
  cv::circle(picture, fine(pixel(middle)), fine_radius, colour, whole(width * texels_per_m()), cv::LINE_AA,
             kShift);
}

void Canvas::ellipse(const cv::Point2d& middle, const cv::Size2d& half, double turn,
                     const cv::Scalar& colour) {
  const double scale = texels_per_m() * (1 << kShift);
  const cv::Size axes(static_cast<int>(std::lround(half.width * scale)),
                      static_cast<int>(std::lround(half.height * scale)));
  cv::ellipse(picture, fine(pixel(middle)), axes, turn * 180 / M_PI, 0, 360, colour, cv::FILLED, cv::LINE_AA,
              kShift);
}

void Canvas::line(const cv::Point2d& from, const cv::Point2d& to, double width, const cv::Scalar& colour) {
  const cv::Point2d along = to - from;
  const double length = std::max(std::hypot(along.x, along.y), 1e-9);
  const cv::Point2d side = cv::Point2d(-along.y, along.x) * (width / 2 / length);
  fill({from + side, to + side, to - side, from - side}, colour);
}

void Canvas::write(const std::string& text, const cv::Point2d& start, double height,
                   const cv::Scalar& colour) {
  // A capital of this typeface is 21 px high at scale 1.
  const double scale = height * texels_per_m() / 21.0;
  cv::putText(picture, text, pixel(start), cv::FONT_HERSHEY_DUPLEX, scale, colour, whole(2.2 * scale),
              cv::LINE_AA);
}

}  // namespace relock::simulator
