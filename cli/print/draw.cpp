#include "cli/print/draw.h"

#include <cairo.h>

#include <algorithm>
#include <memory>
#include <numbers>

#include "core/display_coding.h"

namespace relock {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr int kBorderSteps = 32;  // between which printers and viewers interpolate

using PatternPtr = std::unique_ptr<cairo_pattern_t, void (*)(cairo_pattern_t*)>;
using FontOptionsPtr = std::unique_ptr<cairo_font_options_t, void (*)(cairo_font_options_t*)>;

void set_light(cairo_t* on, double light) {
  const double grey = coded_of_light(light);
  cairo_set_source_rgb(on, grey, grey, grey);
}

/// Of `light` (0 the sheet, 1 white paper) on a sheet of this colour.
Reflected on_sheet(SheetColour sheet, double light) {
  const Reflected dark = reflected_by(sheet);
  const auto mixed = [&](double own) { return own + light * (1 - own); };
  return {mixed(dark.red), mixed(dark.green), mixed(dark.blue)};
}

void add_circle(cairo_t* on, Vec2 centre, double radius) {
  if (radius <= 0) return;
  cairo_new_sub_path(on);
  cairo_arc(on, centre.x, centre.y, radius, 0, kTurn);
  cairo_close_path(on);
}

void draw_soft_border(cairo_t* on, const RingMarker& marker, Vec2 centre, double radius_mm) {
  const double inner = marker.geometry.quiet_zone, outer = marker.geometry.sheet_radius();
  if (outer <= inner) return;
  const PatternPtr border(cairo_pattern_create_radial(centre.x, centre.y, inner * radius_mm, centre.x,
                                                      centre.y, outer * radius_mm),
                          cairo_pattern_destroy);
  for (int step = 0; step <= kBorderSteps; ++step) {
    const double part = static_cast<double>(step) / kBorderSteps;
    const Reflected light = on_sheet(marker.sheet, reflectance(marker, inner + part * (outer - inner)));
    cairo_pattern_add_color_stop_rgb(border.get(), part, coded_of_light(light.red),
                                     coded_of_light(light.green), coded_of_light(light.blue));
  }
  cairo_set_source(on, border.get());
  add_circle(on, centre, outer * radius_mm);
  cairo_fill(on);
}

void draw_rings(cairo_t* on, const RingMarker& marker, Vec2 centre, double radius_mm) {
  const RingGeometry& geometry = marker.geometry;
  if (!geometry.inverted) {
    draw_soft_border(on, marker, centre, radius_mm);
    const Reflected dark = reflected_by(marker.sheet);
    cairo_set_source_rgb(on, coded_of_light(dark.red), coded_of_light(dark.green), coded_of_light(dark.blue));
    add_circle(on, centre, geometry.quiet_zone * radius_mm);
    cairo_fill(on);
  }
  set_light(on, geometry.inverted ? 0 : 1);
  cairo_set_fill_rule(on, CAIRO_FILL_RULE_EVEN_ODD);
  for (const Annulus& ring : rings_of(marker)) {
    add_circle(on, centre, ring.inner * radius_mm);
    add_circle(on, centre, ring.outer * radius_mm);
  }
  cairo_fill(on);
}

/// All black cells are one path: filled one by one, they would show seams of grey between them.
void draw_cells(cairo_t* on, const MarkerCells& cells, const PlacedMarker& marker) {
  const double cell = marker.sheet_mm() / cells.side;
  for (int y = 0; y < cells.side; ++y)
    for (int x = 0; x < cells.side; ++x)
      if (cells.grey[static_cast<std::size_t>(y * cells.side + x)] == 0)
        cairo_rectangle(on, marker.corner_mm.x + x * cell, marker.corner_mm.y + y * cell, cell, cell);
  set_light(on, 0);
  cairo_set_fill_rule(on, CAIRO_FILL_RULE_WINDING);
  cairo_fill(on);
}

/// Letters are made smaller where a line is wider than its marker.
void draw_caption(cairo_t* on, const PlacedMarker& marker) {
  set_light(on, 0);
  for (std::size_t line = 0; line < marker.caption.size(); ++line) {
    const char* const text = marker.caption[line].c_str();
    cairo_text_extents_t extents;
    cairo_set_font_size(on, kCaptionTextMm);
    cairo_text_extents(on, text, &extents);
    const double scale = std::min(1.0, marker.sheet_mm() / std::max(extents.x_advance, 1e-3));
    cairo_set_font_size(on, scale * kCaptionTextMm);
    const double from_left = (marker.sheet_mm() - scale * extents.x_advance) / 2;
    const double baseline = marker.sheet_mm() + kCaptionLineMm * (static_cast<double>(line) + 0.75);
    cairo_move_to(on, marker.corner_mm.x + from_left, marker.corner_mm.y + baseline);
    cairo_show_text(on, text);
  }
}

/// Letters as they are designed, not moved onto the dots: the same places in every format.
void choose_font(cairo_t* on) {
  cairo_select_font_face(on, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  const FontOptionsPtr options(cairo_font_options_create(), cairo_font_options_destroy);
  cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(on, options.get());
}

}  // namespace

void draw(cairo_t* on, const Page& page) {
  set_light(on, 1);
  cairo_paint(on);
  cairo_set_antialias(on, CAIRO_ANTIALIAS_BEST);
  cairo_set_tolerance(on, 0.01);  // of the device: points or dots
  choose_font(on);
  for (const PlacedMarker& marker : page.markers) {
    const double half = marker.sheet_mm() / 2;
    const Vec2 centre = marker.corner_mm + Vec2{half, half};
    if (const auto* ring = std::get_if<RingMarker>(&marker.design.form)) {
      draw_rings(on, *ring, centre, marker.size_mm / 2);
    } else {
      draw_cells(on, std::get<MarkerCells>(marker.design.form), marker);
    }
    draw_caption(on, marker);
  }
}

}  // namespace relock
