#include "tests/detectors/rendered_marker.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace relock {
namespace {

constexpr int kSamples = 8;  // along each side of a pixel
constexpr double kWall = 140, kBlack = 25, kWhite = 235;

/// Grey at a point of the print's plane, where the outline is the square from 0 to 1; the wall outside of it.
double grey_at(const MarkerCells& print, Vec2 point, double wall) {
  const int inner = print.side - 2 * print.margin;
  const double column = point.x * inner + print.margin, row = point.y * inner + print.margin;
  if (!(column >= 0 && row >= 0 && column < print.side && row < print.side)) return wall;
  const auto cell =
      static_cast<std::size_t>(row) * static_cast<std::size_t>(print.side) + static_cast<std::size_t>(column);
  return kBlack + (kWhite - kBlack) * print.grey[cell] / 255.0;
}

cv::Matx33d to_print(const Quad& outline) {
  cv::Point2f seen[4];
  for (std::size_t i = 0; i < 4; ++i)
    seen[i] = {static_cast<float>(outline.corner[i].x), static_cast<float>(outline.corner[i].y)};
  const cv::Point2f print[4] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  return cv::getPerspectiveTransform(seen, print);
}

}  // namespace

void render_into(cv::Mat1b& picture, const MarkerCells& print, const Quad& outline) {
  const cv::Matx33d h = to_print(outline);
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 0; x < picture.cols; ++x) {
      double sum = 0;
      for (int i = 0; i < kSamples * kSamples; ++i) {
        const double u = x - 0.5 + (i % kSamples + 0.5) / kSamples,
                     v = y - 0.5 + (i / kSamples + 0.5) / kSamples;
        const cv::Vec3d p = h * cv::Vec3d(u, v, 1);
        sum += grey_at(print, {p[0] / p[2], p[1] / p[2]}, picture(y, x));
      }
      picture(y, x) = cv::saturate_cast<std::uint8_t>(sum / (kSamples * kSamples));
    }
}

cv::Mat1b rendered_marker(const MarkerCells& print, const Quad& outline, Size picture) {
  cv::Mat1b canvas(picture.height, picture.width, static_cast<std::uint8_t>(kWall));
  render_into(canvas, print, outline);
  return canvas;
}

Quad square(Vec2 centre, double side, double turned_rad) {
  const double c = std::cos(turned_rad) * side / 2, s = std::sin(turned_rad) * side / 2;
  const Vec2 right{c, s}, down{-s, c};
  return {{centre - right - down, centre + right - down, centre + right + down, centre - right + down}};
}

Quad tilted(Vec2 centre, double side) {
  const double h = side / 2;
  return {{centre + Vec2{-h, -h}, centre + Vec2{0.7 * h, -0.8 * h}, centre + Vec2{0.75 * h, 0.7 * h},
           centre + Vec2{-0.95 * h, h}}};
}

cv::Mat1b blurred_along_x(const cv::Mat1b& picture, int length) {
  cv::Mat1b blurred;
  cv::blur(picture, blurred, {length, 1});
  return blurred;
}

cv::Mat3b bgr_of(const cv::Mat1b& gray) {
  cv::Mat3b bgr;
  cv::cvtColor(gray, bgr, cv::COLOR_GRAY2BGR);
  return bgr;
}

}  // namespace relock
