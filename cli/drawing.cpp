#include "cli/drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "cli/files.h"
#include "core/error.h"

namespace relock {
namespace {

// Okabe and Ito, as BGR.
const cv::Scalar kGreen(115, 158, 0), kOrange(0, 94, 213), kWhite(255, 255, 255), kBlack(0, 0, 0);
constexpr int kShift = 4;  // places are drawn in sixteenths of a pixel

cv::Point to_point(Vec2 v) {
  constexpr double scale = 1 << kShift;
  return {static_cast<int>(std::lround(v.x * scale)), static_cast<int>(std::lround(v.y * scale))};
}

/// Lines and letters on pictures of this size.
struct Pen {
  int thickness;
  double letters;  ///< OpenCV's font scale
};
Pen pen_for(const cv::Mat& picture) {
  const double scale = std::max(1., std::max(picture.cols, picture.rows) / 800.);
  return {static_cast<int>(std::lround(scale)), 0.45 * scale};
}

void draw_outline(cv::Mat& picture, const Outline& outline, const Pen& pen) {
  if (const auto* e = std::get_if<Ellipse>(&outline)) {
    const cv::Point axes = to_point({e->semi_major, e->semi_minor});
    cv::ellipse(picture, to_point(e->centre), {axes.x, axes.y}, e->angle_rad * 180 / CV_PI, 0, 360, kGreen,
                pen.thickness, cv::LINE_AA, kShift);
    return;
  }
  std::array<Vec2, 4> corners;
  if (const auto* quad = std::get_if<Quad>(&outline)) {
    corners = quad->corner;
  } else {
    const auto& b = std::get<Box>(outline);
    corners = {{{b.x, b.y}, {b.right(), b.y}, {b.right(), b.bottom()}, {b.x, b.bottom()}}};
  }
  for (std::size_t i = 0; i < 4; ++i)
    cv::line(picture, to_point(corners[i]), to_point(corners[(i + 1) % 4]), kGreen, pen.thickness,
             cv::LINE_AA, kShift);
}

void draw_centre(cv::Mat& picture, Vec2 centre, const Pen& pen) {
  const double reach = 5. * pen.thickness;
  for (const Vec2 arm : {Vec2{reach, 0}, Vec2{0, reach}})
    cv::line(picture, to_point(centre - arm), to_point(centre + arm), kOrange, pen.thickness, cv::LINE_AA,
             kShift);
}

/// Above the outline, or below it where the picture ends; white with a dark rim is read on any ground.
void draw_label(cv::Mat& picture, const std::string& label, const Box& box, const Pen& pen) {
  int below = 0;
  const cv::Size size = cv::getTextSize(label, cv::FONT_HERSHEY_SIMPLEX, pen.letters, pen.thickness, &below);
  const int gap = 4 * pen.thickness;
  int x = static_cast<int>(std::lround(box.x)), y = static_cast<int>(std::lround(box.y)) - gap;
  if (y - size.height < 0) y = static_cast<int>(std::lround(box.bottom())) + gap + size.height;
  x = std::clamp(x, 0, std::max(0, picture.cols - size.width));
  y = std::clamp(y, size.height, std::max(size.height, picture.rows - below));
  for (const auto& [colour, thickness] :
       {std::pair{kBlack, 3 * pen.thickness}, std::pair{kWhite, pen.thickness}})
    cv::putText(picture, label, {x, y}, cv::FONT_HERSHEY_SIMPLEX, pen.letters, colour, thickness,
                cv::LINE_AA);
}

}  // namespace

cv::Mat drawn(const cv::Mat& picture, const Sightings& sightings) {
  cv::Mat canvas;
  if (picture.channels() == 1) {
    cv::cvtColor(picture, canvas, cv::COLOR_GRAY2BGR);
  } else {
    canvas = picture.clone();
  }
  const Pen pen = pen_for(canvas);
  for (const Sighting& s : sightings) {
    draw_outline(canvas, s.outline, pen);
    draw_centre(canvas, s.centre, pen);
  }
  for (const Sighting& s : sightings)  // over all outlines
    draw_label(canvas, s.code ? to_string(*s.code) : fmt::format("{:.2f}", s.confidence), bounds(s.outline),
               pen);
  return canvas;
}

void write_picture(const std::filesystem::path& path, const cv::Mat& picture) {
  std::vector<std::uint8_t> bytes;
  bool encoded = false;
  try {
    encoded = cv::imencode(path.extension().string(), picture, bytes);
  } catch (const cv::Exception&) {  // an ending that OpenCV does not know
  }
  if (!encoded)
    throw Error(fmt::format("{} cannot be written; a picture's name ends in .png or .jpg", path.string()));
  write_file(path, std::string(bytes.begin(), bytes.end()));
}

}  // namespace relock
