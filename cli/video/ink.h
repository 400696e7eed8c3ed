#pragma once

#include <cairo.h>

#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>
#include <string_view>

#include "core/geometry.h"

// Lines, letters and pictures on a sheet of pixels, by Cairo. Places are px from the sheet's upper left corner.

namespace relock::ink {

constexpr std::string_view kBlack = "#222222", kGrey = "#808080", kWhite = "#ffffff", kLight = "#dddddd";

/// White at first.
class Sheet {
 public:
  explicit Sheet(Size size);
  cairo_t* on() const { return context_.get(); }
  Size size() const { return {pixels_.cols, pixels_.rows}; }
  /// What was drawn so far, CV_8UC3.
  cv::Mat picture() const;

 private:
  struct Free {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
    void operator()(cairo_t* context) const { cairo_destroy(context); }
  };
  cv::Mat pixels_;
  std::unique_ptr<cairo_surface_t, Free> surface_;
  std::unique_ptr<cairo_t, Free> context_;
};

/// "#rrggbb".
void set_colour(cairo_t* on, std::string_view colour, double alpha = 1);
void fill_box(cairo_t* on, const Box& box, std::string_view colour, double alpha = 1);
/// A picture (CV_8UC3) so that it fills the box.
void paint(cairo_t* on, const cv::Mat& picture, const Box& box);

struct Letters {
  double height_px = 12;
  bool bold = false;
};
double width_of(cairo_t* on, std::string_view text, const Letters& letters);
/// From `at`, the left end of the letters' base line.
void write(cairo_t* on, std::string_view text, Vec2 at, const Letters& letters, std::string_view colour);
/// The text, its end replaced by "…" where it is wider.
std::string fitted(cairo_t* on, const std::string& text, double width_px, const Letters& letters);

}  // namespace relock::ink
