#include "cli/plot/look.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "cli/terminal.h"
#include "core/error.h"

namespace relock::figure {
namespace {

constexpr double kMmPerPoint = 25.4 / 72;

struct Shape {
  int type;  ///< gnuplot's pt
  double size;
};
// As far from each other as can be, the filled ones first; sizes so that all look equally large.
constexpr std::array<Shape, 12> kShapes{{{7, .6},
                                         {5, .55},
                                         {9, .75},
                                         {13, .75},
                                         {11, .75},
                                         {2, .65},
                                         {6, .7},
                                         {4, .6},
                                         {8, .8},
                                         {12, .8},
                                         {1, .75},
                                         {10, .8}}};
constexpr std::array<std::string_view, 5> kDashes{"solid", "(12,5)", "(3,4)", "(14,4,3,4)", "(24,6)"};

std::string points_of(const Shape& shape) {
  return fmt::format("pointtype {} pointsize {:g} * mark", shape.type, shape.size);
}

}  // namespace

std::string_view colour(std::size_t i) {
  constexpr std::array<std::string_view, 7> kOkabeIto{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                      "#e69f00", "#56b4e9", "#000000"};
  return kOkabeIto[i % kOkabeIto.size()];
}

CurveLook curve_look(std::size_t i) {
  return {fmt::format("linewidth {} linecolor rgb '{}' dashtype {}", kCurve, colour(i),
                      kDashes[i % kDashes.size()]),
          points_of(kShapes[i % kShapes.size()]), std::string(colour(i))};
}

CurveLook published_look(std::size_t i) {
  // Open shapes, and every second one darker.
  constexpr std::array<int, 5> kOpen{6, 4, 8, 12, 10};
  const std::string grey(i % 2 == 0 ? kGrey : "#505050");
  const std::array<std::string_view, 3> dashes{"(9,7)", "(4,6)", "(14,5,3,5)"};
  return {fmt::format("linewidth {} linecolor rgb '{}' dashtype {}", kCurve, grey, dashes[i % dashes.size()]),
          points_of({kOpen[i % kOpen.size()], .8}), grey};
}

std::string legible(std::string_view text) {
  std::string whole;
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i]);
    const std::size_t length = lead < 0x80 ? 1 : lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
    const std::string_view character = text.substr(i, length);
    const bool starts = lead < 0x80 || (lead >= 0xc2 && lead <= 0xf4);
    const bool goes_on = std::all_of(character.begin() + 1, character.end(),
                                     [](char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; });
    if (!starts || character.size() < length || !goes_on) {
      whole += "\xef\xbf\xbd";  // U+FFFD
      ++i;
      continue;
    }
    const bool control = lead < 0x20 || lead == 0x7f;
    whole += control ? " " : std::string(character);
    i += length;
  }
  return whole;
}

std::string literal(std::string_view text) {
  // Between single quotes gnuplot changes nothing but two quotes into one.
  std::string inside;
  for (const char c : legible(text)) inside += c == '\'' ? "''" : std::string(1, c);
  return "'" + inside + "'";
}

double width_mm(std::string_view text, double letters_pt) {
  return static_cast<double>(columns_of(text)) * letters_pt * kMmPerPoint * 0.58;  // DejaVu Sans, on average
}

Lines broken(std::string_view text, double width, double letters_pt) {
  std::vector<std::string> lines{""};
  const std::string whole = legible(text);
  for (std::size_t at = 0; at < whole.size();) {
    const std::size_t end = std::min(whole.find(' ', at), whole.size());
    const std::string word = whole.substr(at, end - at);
    if (!lines.back().empty() && width_mm(lines.back() + " " + word, letters_pt) > width)
      lines.emplace_back();
    lines.back() += (lines.back().empty() ? "" : " ") + word;
    at = end + 1;
  }
  Lines result{literal(lines[0]), lines.size()};
  for (std::size_t i = 1; i < lines.size(); ++i) result.literal += " . \"\\n\" . " + literal(lines[i]);
  return result;
}

void Extent::add(double value) {
  if (!std::isfinite(value)) return;
  low = std::min(low.value_or(value), value);
  high = std::max(high.value_or(value), value);
}

std::string axis(std::string_view name, const PlotAxis& axis, const Extent& data) {
  double low = axis.low.value_or(data.low.value_or(axis.logarithmic ? 1 : 0));
  double high = axis.high.value_or(data.high.value_or(axis.logarithmic ? 10 : 1));
  bool widened = !data.low;
  if (axis.low && axis.high && !(low < high))
    throw Error(fmt::format("the axis \"{}\" of a plot cannot go from {:g} to {:g}", axis.title, low, high));
  if (axis.logarithmic && !(low > 0 && (high > 0 || !axis.high)))
    throw Error(fmt::format("the axis \"{}\" of a plot is logarithmic and cannot go from {:g} to {:g}",
                            axis.title, low, high));
  if (!(low < high)) {
    // A single value, or all of them beyond the one end that was stated.
    const double margin = std::max(std::abs(axis.low ? low : high) * .1, axis.logarithmic ? 0 : 1e-3);
    if (!axis.high) high = axis.logarithmic ? 2 * low : (axis.low ? low : high) + margin;
    if (!axis.low) low = axis.logarithmic ? high / 4 : high - 2 * margin;
    widened = true;
  }
  const auto end = [&](const std::optional<double>& stated, double value) {
    return stated || widened ? fmt::format("{}", value) : std::string("*");
  };
  return fmt::format("set {0}range [{1}:{2}]\nset {0}label {3} textcolor rgb '{4}'\n{5}", name,
                     end(axis.low, low), end(axis.high, high), literal(axis.title), kInk,
                     axis.logarithmic ? fmt::format("set logscale {}\n", name) : "");
}

}  // namespace relock::figure
