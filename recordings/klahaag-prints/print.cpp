#include "print.h"

#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>

#include <cmath>
#include <cstdlib>
#include <memory>
#include <opencv2/core/version.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#if CV_VERSION_MAJOR * 100 + CV_VERSION_MINOR >= 407
#include <opencv2/objdetect/aruco_detector.hpp>
#include <opencv2/objdetect/aruco_dictionary.hpp>
#else
#include <opencv2/aruco.hpp>
#endif

namespace recordings {
namespace {

constexpr int kSupersampling = 4;  // per pixel and direction

// Premultiplied BGR in 0..2, cover in 3.
using Layer = cv::Mat_<cv::Vec4f>;

// What the print shows at a place in units of the outline; cover 0 outside of the board.
cv::Vec4f ink_at(const cv::Mat1b& cells, const cv::Point2d& place, const Look& look) {
  const double margin = look.margin_cells / cells.cols;
  const double low = -margin;
  const double high = 1 + margin;
  if (place.x < low || place.y < low || place.x > high || place.y > high) return {0, 0, 0, 0};
  const int column = static_cast<int>(std::floor(place.x * cells.cols));
  const int row = static_cast<int>(std::floor(place.y * cells.rows));
  const bool inside = column >= 0 && row >= 0 && column < cells.cols && row < cells.rows;
  const cv::Vec3d colour = !inside || cells(row, column) != 0 ? look.white : look.black;
  return {static_cast<float>(colour[0]), static_cast<float>(colour[1]), static_cast<float>(colour[2]), 1};
}

// The part of the picture the board and its shadow can touch, px; may reach beyond the picture.
cv::Rect reach(const std::vector<Pose>& exposure) {
  std::vector<cv::Point2f> corners;
  for (const Pose& pose : exposure) {
    for (const cv::Point2d& p : {cv::Point2d(-0.3, -0.3), {1.3, -0.3}, {1.3, 1.3}, {-0.3, 1.3}}) {
      corners.emplace_back(project(pose, p));
    }
  }
  const cv::Rect box = cv::boundingRect(corners);
  const int blur_and_shadow = 12;
  return {box.x - blur_and_shadow, box.y - blur_and_shadow, box.width + 2 * blur_and_shadow,
          box.height + 2 * blur_and_shadow};
}

// Mean over the pixel's area and over the exposure.
cv::Vec4f light_on_pixel(const cv::Mat1b& cells, const std::vector<Pose>& to_print, const cv::Point& pixel,
                         const Look& look) {
  cv::Vec4f sum(0, 0, 0, 0);
  for (const Pose& pose : to_print) {
    for (int sy = 0; sy < kSupersampling; ++sy) {
      for (int sx = 0; sx < kSupersampling; ++sx) {
        const double x = pixel.x - 0.5 + (sx + 0.5) / kSupersampling;
        const double y = pixel.y - 0.5 + (sy + 0.5) / kSupersampling;
        sum += ink_at(cells, project(pose, {x, y}), look);
      }
    }
  }
  return sum * (1.0F / static_cast<float>(to_print.size() * kSupersampling * kSupersampling));
}

Layer render(const cv::Mat1b& cells, const std::vector<Pose>& exposure, const cv::Rect& area,
             const Look& look) {
  std::vector<Pose> to_print;
  for (const Pose& pose : exposure) to_print.push_back(pose.inv());
  Layer layer(area.size());
  for (int y = 0; y < area.height; ++y) {
    for (int x = 0; x < area.width; ++x) {
      layer(y, x) = light_on_pixel(cells, to_print, {area.x + x, area.y + y}, look);
    }
  }
  cv::GaussianBlur(layer, layer, cv::Size(), look.lens_blur_px);
  return layer;
}

cv::Mat1f shadow_of(const Layer& board, const Look& look) {
  cv::Mat1f cover;
  cv::extractChannel(board, cover, 3);
  cv::Mat1f shadow;
  const cv::Matx23d shift(1, 0, look.shadow.x, 0, 1, look.shadow.y);
  cv::warpAffine(cover, shadow, shift, cover.size());
  cv::GaussianBlur(shadow, shadow, cv::Size(), 2.0);
  return shadow;
}

// The scene's own light and shade around the board, as a factor with mean 1 over `inside`.
cv::Mat1f light_around(const cv::Mat3b& picture, const cv::Rect& inside, double strength) {
  cv::Mat1b grey;
  cv::cvtColor(picture, grey, cv::COLOR_BGR2GRAY);
  cv::Mat1f smooth;
  grey.convertTo(smooth, CV_32F);
  cv::GaussianBlur(smooth, smooth, cv::Size(), 15.0);
  const double mean = cv::mean(smooth(inside))[0];
  cv::Mat1f factor;
  smooth.convertTo(factor, CV_32F, strength / mean, 1 - strength);
  return factor;
}

unsigned char level(double value) { return cv::saturate_cast<unsigned char>(std::lround(value)); }

}  // namespace

cv::Mat1b aruco6x6_250_cells(int id) {
  const int side = 8;  // six cells of code, one of border on each side
  cv::Mat1b cells;
#if CV_VERSION_MAJOR * 100 + CV_VERSION_MINOR >= 407
  cv::aruco::generateImageMarker(cv::aruco::getPredefinedDictionary(cv::aruco::DICT_6X6_250), id, side, cells,
                                 1);
#else
  cv::aruco::drawMarker(cv::aruco::getPredefinedDictionary(cv::aruco::DICT_6X6_250), id, side, cells, 1);
#endif
  return cells;
}

// The library's picture has one white cell around the black border: it is not part of the outline.
cv::Mat1b apriltag36h11_cells(int id) {
  const std::unique_ptr<apriltag_family_t, void (*)(apriltag_family_t*)> family(tag36h11_create(),
                                                                                &tag36h11_destroy);
  // image_u8_destroy() is not in every build of the library; it frees these two.
  image_u8_t* const picture = apriltag_to_image(family.get(), id);
  const std::unique_ptr<image_u8_t, void (*)(void*)> free_picture(picture, &std::free);
  const std::unique_ptr<std::uint8_t, void (*)(void*)> free_pixels(picture->buf, &std::free);
  const cv::Mat1b whole(picture->height, picture->width, picture->buf,
                        static_cast<std::size_t>(picture->stride));
  return whole(cv::Rect(1, 1, whole.cols - 2, whole.rows - 2)).clone();
}

Pose pose_of(const Quad& outline) {
  const std::vector<cv::Point2f> unit{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const std::vector<cv::Point2f> corners(outline.begin(), outline.end());
  return cv::getPerspectiveTransform(unit, corners);
}

cv::Point2d project(const Pose& pose, const cv::Point2d& p) {
  const double w = pose(2, 0) * p.x + pose(2, 1) * p.y + pose(2, 2);
  return {(pose(0, 0) * p.x + pose(0, 1) * p.y + pose(0, 2)) / w,
          (pose(1, 0) * p.x + pose(1, 1) * p.y + pose(1, 2)) / w};
}

Quad outline_of(const Pose& pose) {
  return {project(pose, {0, 0}), project(pose, {1, 0}), project(pose, {1, 1}), project(pose, {0, 1})};
}

double Noise::normal() {
  double sum = -6;
  for (int i = 0; i < 12; ++i) {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    sum += static_cast<double>(state_ >> 40) / static_cast<double>(1U << 24);
  }
  return sum;
}

void draw_print(cv::Mat3b& picture, const cv::Mat1b& cells, const std::vector<Pose>& exposure,
                const Look& look, Noise& noise) {
  const cv::Rect area = reach(exposure);
  const cv::Rect inside = area & cv::Rect(cv::Point(0, 0), picture.size());
  if (inside.empty()) return;
  const Layer board = render(cells, exposure, area, look);
  const cv::Mat1f shadow = shadow_of(board, look);
  const cv::Mat1f light = light_around(picture, inside, look.local_light);
  for (int y = inside.y; y < inside.br().y; ++y) {
    for (int x = inside.x; x < inside.br().x; ++x) {
      const cv::Vec4f& print = board(y - area.y, x - area.x);
      const double cover = print[3];
      const double behind = (1 - cover) * (1 - look.shadow_depth * shadow(y - area.y, x - area.x));
      const double grain = cover * look.noise * noise.normal();
      for (int c = 0; c < 3; ++c) {
        picture(y, x)[c] = level(behind * picture(y, x)[c] + light(y, x) * print[c] + grain);
      }
    }
  }
}

}  // namespace recordings
