#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "cli/plot/plot.h"

// How curves, texts and axes of all plots look, in gnuplot's language.

namespace relock::figure {

constexpr double kText = 8;  ///< size of letters, pt
/// Thicknesses of lines, pt.
constexpr double kCurve = 1.1, kWhisker = 0.7, kAxis = 0.6, kGrid = 0.4;
constexpr std::string_view kInk = "#222222", kGrey = "#808080";

/// Colours that are told apart by people who see few of them (Okabe and Ito, without their yellow, which white
/// paper swallows); they repeat.
std::string_view colour(std::size_t i);

/// How the i-th curve is told from the others: 84 differ in colour or shape of their points, and lines in their
/// dashes, too. Published ones are grey and dashed.
struct CurveLook {
  std::string line;    ///< thickness, colour and dashes
  std::string points;  ///< shape and size
  std::string colour;
};
CurveLook curve_look(std::size_t i);
CurveLook published_look(std::size_t i);

/// A text on one line; control characters are spaces, and bytes that are no UTF-8 are U+FFFD.
std::string legible(std::string_view text);
/// A text as gnuplot takes it, whatever is in it: on one line, and well-formed UTF-8.
std::string literal(std::string_view text);
/// Likewise on several lines, none longer than `width_mm`, for a title whose letters are `letters_pt` high.
struct Lines {
  std::string literal;
  std::size_t count = 0;
};
Lines broken(std::string_view text, double width_mm, double letters_pt);
/// The width that a text needs, about.
double width_mm(std::string_view text, double letters_pt);

/// Least and greatest of what is drawn.
struct Extent {
  std::optional<double> low = {}, high = {};
  void add(double value);
};
/// `set xrange`, its title and its scale; `name` is x or y. Throws Error when the axis' ends are not in order.
std::string axis(std::string_view name, const PlotAxis& axis, const Extent& data);

}  // namespace relock::figure
