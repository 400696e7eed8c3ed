#include "cli/map/canvas.h"

#include <cairo-svg.h>
#include <cairo.h>
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace relock::maps {
namespace {

constexpr double kMmPerInch = 25.4, kPointsPerMm = 72 / kMmPerInch;
constexpr double kCapitals = 0.72;  // height of capitals, of the letters' size

using SurfacePtr = std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)>;
using ContextPtr = std::unique_ptr<cairo_t, void (*)(cairo_t*)>;
using FontOptionsPtr = std::unique_ptr<cairo_font_options_t, void (*)(cairo_font_options_t*)>;

cairo_status_t append(void* content, const unsigned char* bytes, unsigned int count) {
  static_cast<std::string*>(content)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

void check_status(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS)
    throw Error(fmt::format("Cairo cannot draw this map: {}", cairo_status_to_string(status)));
}

/// Cairo numbers the surfaces of a process, and writes the number of this one, which nothing refers to.
void remove_surface_number(std::string& svg) {
  constexpr std::string_view kBegin = " id=\"surface";
  const std::size_t at = svg.find(kBegin);
  if (at == std::string::npos) return;
  const std::size_t end = svg.find('"', at + kBegin.size());
  svg.erase(at, end + 1 - at);
}

void draw_on(cairo_surface_t* surface, double units_per_mm, const std::function<void(Canvas&)>& draw) {
  const ContextPtr context(cairo_create(surface), cairo_destroy);
  cairo_scale(context.get(), units_per_mm, units_per_mm);
  Canvas canvas(context.get());
  draw(canvas);
  check_status(cairo_status(context.get()));
}

}  // namespace

Canvas::Canvas(cairo_t* on) : on_(on) {
  colour({1, 1, 1});
  cairo_paint(on_);
  cairo_select_font_face(on_, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  // Letters as they are designed, not moved onto the dots: the same places in every format.
  const FontOptionsPtr options(cairo_font_options_create(), cairo_font_options_destroy);
  cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(on_, options.get());
}

void Canvas::colour(const Colour& colour, double opacity) {
  cairo_set_source_rgba(on_, colour.red, colour.green, colour.blue, opacity);
}

void Canvas::fill(const Rectangle& area, const Colour& with, double opacity) {
  colour(with, opacity);
  cairo_rectangle(on_, area.x, area.y, area.width, area.height);
  cairo_fill(on_);
}

void Canvas::frame(const Rectangle& area, const Colour& with, double width) {
  colour(with);
  cairo_set_line_width(on_, width);
  cairo_rectangle(on_, area.x, area.y, area.width, area.height);
  cairo_stroke(on_);
}

void Canvas::hatch(const Rectangle& area, const Colour& with, double spacing, double width) {
  cairo_save(on_);
  cairo_rectangle(on_, area.x, area.y, area.width, area.height);
  cairo_clip(on_);
  colour(with);
  cairo_set_line_width(on_, width);
  // Lines x + y = n spacing of the whole page, so that those of neighbours meet.
  const double first = std::ceil((area.x + area.y) / spacing) * spacing;
  for (double sum = first; sum <= area.right() + area.bottom(); sum += spacing) {
    cairo_move_to(on_, sum - area.y, area.y);
    cairo_line_to(on_, sum - area.bottom(), area.bottom());
  }
  cairo_stroke(on_);
  cairo_restore(on_);
}

void Canvas::line(double x0, double y0, double x1, double y1, const Colour& with, double width) {
  colour(with);
  cairo_set_line_width(on_, width);
  cairo_set_line_cap(on_, CAIRO_LINE_CAP_SQUARE);
  cairo_move_to(on_, x0, y0);
  cairo_line_to(on_, x1, y1);
  cairo_stroke(on_);
}

double Canvas::width_of(const std::string& words, double size) {
  cairo_text_extents_t extents;
  cairo_set_font_size(on_, size);
  cairo_text_extents(on_, words.c_str(), &extents);
  return extents.x_advance;
}

void Canvas::text(const std::string& words, double x, double y, double size, const Colour& with,
                  Anchor anchor) {
  const double width = width_of(words, size);
  const double left = anchor == Anchor::left ? x : anchor == Anchor::middle ? x - width / 2 : x - width;
  colour(with);
  cairo_move_to(on_, left, y + kCapitals * size / 2);
  cairo_show_text(on_, words.c_str());
  cairo_new_path(on_);
}

void Canvas::rimmed_text(const std::string& words, double x, double y, double size, const Colour& with,
                         const Colour& rim) {
  constexpr double kRim = 0.45;  // of the letters' size
  cairo_move_to(on_, x - width_of(words, size) / 2, y + kCapitals * size / 2);
  cairo_text_path(on_, words.c_str());
  cairo_set_line_join(on_, CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_width(on_, kRim * size);
  colour(rim);
  cairo_stroke(on_);
  text(words, x, y, size, with, Anchor::middle);
}

void Canvas::upright_text(const std::string& words, double x, double y, double size, const Colour& with) {
  cairo_save(on_);
  cairo_translate(on_, x, y);
  cairo_rotate(on_, -std::acos(-1) / 2);
  text(words, 0, 0, size, with, Anchor::middle);
  cairo_restore(on_);
}

std::string svg_of_page(double width_mm, double height_mm, const std::function<void(Canvas&)>& draw) {
  std::string content;
  const SurfacePtr surface(cairo_svg_surface_create_for_stream(append, &content, width_mm * kPointsPerMm,
                                                               height_mm * kPointsPerMm),
                           cairo_surface_destroy);
  draw_on(surface.get(), kPointsPerMm, draw);
  cairo_surface_finish(surface.get());
  check_status(cairo_surface_status(surface.get()));
  remove_surface_number(content);
  return content;
}

std::string png_of_page(double width_mm, double height_mm, double dpi,
                        const std::function<void(Canvas&)>& draw) {
  const double dots_per_mm = dpi / kMmPerInch;
  const SurfacePtr surface(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(std::ceil(width_mm * dots_per_mm)),
                                 static_cast<int>(std::ceil(height_mm * dots_per_mm))),
      cairo_surface_destroy);
  check_status(cairo_surface_status(surface.get()));
  draw_on(surface.get(), dots_per_mm, draw);
  cairo_surface_flush(surface.get());
  const cv::Mat4b drawn(cairo_image_surface_get_height(surface.get()),
                        cairo_image_surface_get_width(surface.get()),
                        reinterpret_cast<cv::Vec4b*>(cairo_image_surface_get_data(surface.get())),
                        static_cast<std::size_t>(cairo_image_surface_get_stride(surface.get())));
  cv::Mat3b opaque(drawn.size());
  for (int y = 0; y < drawn.rows; ++y)
    for (int x = 0; x < drawn.cols; ++x) opaque(y, x) = {drawn(y, x)[0], drawn(y, x)[1], drawn(y, x)[2]};
  std::vector<unsigned char> encoded;
  if (!cv::imencode(".png", opaque, encoded, {cv::IMWRITE_PNG_COMPRESSION, 9}))
    throw Error("this OpenCV cannot write PNG");
  return {encoded.begin(), encoded.end()};
}

}  // namespace relock::maps
