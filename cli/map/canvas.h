#pragma once

#include <functional>
#include <string>

#include "cli/map/colours.h"

typedef struct _cairo cairo_t;

namespace relock::maps {

struct Rectangle {
  double x = 0, y = 0, width = 0, height = 0;  ///< mm

  double right() const { return x + width; }
  double bottom() const { return y + height; }
  double middle_x() const { return x + width / 2; }
  double middle_y() const { return y + height / 2; }
};

/// Where a text stands with regard to the point that is given for it.
enum class Anchor { left, middle, right };

/// A page to draw on, by Cairo; lengths are mm, y down.
class Canvas {
 public:
  explicit Canvas(cairo_t* on);

  void fill(const Rectangle& area, const Colour& colour, double opacity = 1);
  void frame(const Rectangle& area, const Colour& colour, double width);
  /// Diagonal lines.
  void hatch(const Rectangle& area, const Colour& colour, double spacing, double width);
  void line(double x0, double y0, double x1, double y1, const Colour& colour, double width);
  /// `y`: of the middle of its capitals; `size`: of the letters.
  void text(const std::string& words, double x, double y, double size, const Colour& colour, Anchor anchor);
  /// The same with a rim in another colour, to be read on hatching.
  void rimmed_text(const std::string& words, double x, double y, double size, const Colour& colour,
                   const Colour& rim);
  /// Upwards, its middle at (x, y).
  void upright_text(const std::string& words, double x, double y, double size, const Colour& colour);
  double width_of(const std::string& words, double size);

 private:
  void colour(const Colour& colour, double opacity = 1);

  cairo_t* on_;
};

/// What `draw` draws on a page of this size, as a file's content. The same drawing, the same bytes.
std::string svg_of_page(double width_mm, double height_mm, const std::function<void(Canvas&)>& draw);
std::string png_of_page(double width_mm, double height_mm, double dpi,
                        const std::function<void(Canvas&)>& draw);

}  // namespace relock::maps
