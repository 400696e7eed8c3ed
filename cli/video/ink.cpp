#include "cli/video/ink.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "cli/plot/look.h"
#include "core/error.h"

namespace relock::ink {
namespace {

constexpr const char* kFont = "DejaVu Sans";  // as on plots (cli/plot/sheet.cpp)

double part(std::string_view colour, std::size_t at) {
  return std::stoi(std::string(colour.substr(at, 2)), nullptr, 16) / 255.;
}

void choose(cairo_t* on, const Letters& letters) {
  cairo_select_font_face(on, kFont, CAIRO_FONT_SLANT_NORMAL,
                         letters.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(on, letters.height_px);
}

}  // namespace

Sheet::Sheet(Size size) : pixels_(size.height, size.width, CV_8UC4, cv::Scalar::all(255)) {
  surface_.reset(cairo_image_surface_create_for_data(pixels_.data, CAIRO_FORMAT_RGB24, pixels_.cols,
                                                     pixels_.rows, static_cast<int>(pixels_.step)));
  context_.reset(cairo_create(surface_.get()));
  if (cairo_status(context_.get()) != CAIRO_STATUS_SUCCESS)
    throw Error("there is no memory for the pictures of a video");
  cairo_set_line_join(context_.get(), CAIRO_LINE_JOIN_ROUND);
}

cv::Mat Sheet::picture() const {
  cairo_surface_flush(surface_.get());
  cv::Mat bgr;
  cv::cvtColor(pixels_, bgr, cv::COLOR_BGRA2BGR);
  return bgr;
}

void set_colour(cairo_t* on, std::string_view colour, double alpha) {
  cairo_set_source_rgba(on, part(colour, 1), part(colour, 3), part(colour, 5), alpha);
}

void fill_box(cairo_t* on, const Box& box, std::string_view colour, double alpha) {
  set_colour(on, colour, alpha);
  cairo_rectangle(on, box.x, box.y, box.width, box.height);
  cairo_fill(on);
}

void paint(cairo_t* on, const cv::Mat& picture, const Box& box) {
  cv::Mat scaled, pixels;
  const cv::Size size(std::max(1, cvRound(box.width)), std::max(1, cvRound(box.height)));
  if (size == picture.size())
    scaled = picture;
  else
    cv::resize(picture, scaled, size, 0, 0, size.width < picture.cols ? cv::INTER_AREA : cv::INTER_LINEAR);
  cv::cvtColor(scaled, pixels, cv::COLOR_BGR2BGRA);
  cairo_surface_t* source = cairo_image_surface_create_for_data(pixels.data, CAIRO_FORMAT_RGB24, pixels.cols,
                                                                pixels.rows, static_cast<int>(pixels.step));
  cairo_set_source_surface(on, source, box.x, box.y);
  cairo_rectangle(on, box.x, box.y, box.width, box.height);
  cairo_fill(on);
  cairo_set_source_rgb(on, 0, 0, 0);  // lets go of the pixels
  cairo_surface_destroy(source);
}

double width_of(cairo_t* on, std::string_view text, const Letters& letters) {
  choose(on, letters);
  cairo_text_extents_t extents;
  cairo_text_extents(on, figure::legible(text).c_str(), &extents);
  return extents.x_advance;
}

void write(cairo_t* on, std::string_view text, Vec2 at, const Letters& letters, std::string_view colour) {
  choose(on, letters);
  set_colour(on, colour);
  cairo_move_to(on, at.x, at.y);
  cairo_show_text(on, figure::legible(text).c_str());
}

std::string fitted(cairo_t* on, const std::string& text, double width_px, const Letters& letters) {
  if (width_of(on, text, letters) <= width_px) return text;
  std::string short_text = text;
  while (!short_text.empty() && width_of(on, short_text + "…", letters) > width_px) {
    do {  // a whole character of UTF-8
      short_text.pop_back();
    } while (!short_text.empty() && (static_cast<unsigned char>(short_text.back()) & 0xc0) == 0x80);
    if (!short_text.empty() && static_cast<unsigned char>(short_text.back()) >= 0xc0) short_text.pop_back();
  }
  return short_text + "…";
}

}  // namespace relock::ink
