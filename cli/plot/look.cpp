#include "cli/plot/look.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "cli/files.h"
#include "cli/plot/gnuplot.h"
#include "cli/terminal.h"
#include "core/error.h"

namespace relock::figure {
namespace {

constexpr std::string_view kFont = "DejaVu Sans";
constexpr double kMmPerPoint = 25.4 / 72;
constexpr double kRow = 3.9;       // mm, from one line of text to the next
constexpr double kTitleFrom = 18;  // mm that the title cannot have, about: left of the panel

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

/// What is no character for a drawing (control characters, broken UTF-8) is left out.
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

/// A terminal of gnuplot, and what a sheet, letters, lines and points of a stated size are to it.
struct Terminal {
  std::string_view name;
  std::string_view unit;  ///< of a sheet's size
  double units_per_inch;
  double letters, lines, points;  ///< times pt
  std::string_view more;
};
const Terminal& terminal_for(const std::filesystem::path& file) {
  static const std::map<std::string, Terminal> known{
      {".svg", {"svg", "", 96, 96. / 72, 96. / 72, 1, "background '#ffffff'"}},
      {".pdf", {"pdfcairo", "in", 1, 1.5, 2, .75, ""}},
      {".png", {"pngcairo", "", 200, 200. / 96, 200. / 72, 1.6, ""}}};
  const auto found = known.find(file.extension().string());
  if (found == known.end())
    throw Error(fmt::format("{} cannot be drawn; a plot's name ends in .svg, .pdf or .png", file.string()));
  return found->second;
}

std::string set_terminal(const Terminal& terminal, double width_mm, double height_mm) {
  const auto size = [&](double mm) {
    const double units = mm / 25.4 * terminal.units_per_inch;
    return fmt::format("{:g}{}", terminal.unit.empty() ? std::round(units) : units, terminal.unit);
  };
  return fmt::format("set terminal {} noenhanced size {},{} font '{},{:g}' linewidth {:g} {}\n",
                     terminal.name, size(width_mm), size(height_mm), kFont, kText * terminal.letters,
                     terminal.lines, terminal.more) +
         fmt::format("set encoding utf8\nmark = {:g}\n", terminal.points);
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

std::string literal(std::string_view text) {
  // Between single quotes gnuplot changes nothing but two quotes into one.
  std::string inside;
  for (const char c : legible(text)) inside += c == '\'' ? "''" : std::string(1, c);
  return "'" + inside + "'";
}

std::size_t columns_in(std::string_view text) { return columns_of(text); }

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

std::string axis(std::string_view name, const PlotAxis& axis, const Extent& data, double length_mm) {
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
  const Lines title = broken(axis.title, length_mm, kText);
  return fmt::format("set {0}range [{1}:{2}]\nset {0}label {3} textcolor rgb '{4}'\n{5}", name,
                     end(axis.low, low), end(axis.high, high), title.literal, kInk,
                     axis.logarithmic ? fmt::format("set logscale {}\n", name) : "");
}

Legend legend_for(const std::vector<std::string>& names, double width) {
  if (names.empty()) return {"unset key\n"};
  double longest = 0;
  for (const std::string& name : names) longest = std::max(longest, width_mm(name, kText));
  if (longest > .3 * width) return legend_below(names, width);
  return {"set key outside right top vertical Left reverse samplen 3 spacing 1.15\n"};
}

Legend legend_below(const std::vector<std::string>& names, double width) {
  if (names.empty()) return {"unset key\n"};
  double longest = 0;
  for (const std::string& name : names) longest = std::max(longest, width_mm(name, kText));
  constexpr double kSample = 14;  // mm, with the room around it
  const auto columns =
      std::clamp<std::size_t>(static_cast<std::size_t>(width / (1.1 * longest + kSample)), 1, names.size());
  const std::size_t rows = (names.size() + columns - 1) / columns;
  // Vertical, because horizontally gnuplot makes no use of the room beside the panel.
  return {fmt::format(
              "set key at screen 0.5, screen 0.01 center bottom vertical maxrows {} Left reverse samplen 3 "
              "spacing 1.15\n",
              rows),
          rows};
}

namespace {

struct Margins {
  double above, below;  ///< mm
};
Margins margins_of(const Sheet& sheet) {
  const Lines title = broken(sheet.title, sheet.width_mm - kTitleFrom, kText);
  const double above = sheet.title.empty() ? 3 : 2.5 + static_cast<double>(title.count) * kRow;
  return {above, 11.5 + static_cast<double>(sheet.rows_below) * kRow};
}

}  // namespace

double margins_mm(const Sheet& sheet) {
  const Margins margins = margins_of(sheet);
  return margins.above + margins.below;
}

std::string sheet(const Sheet& sheet) {
  const Margins margins = margins_of(sheet);
  std::string script = fmt::format(
      "set border 3 back linetype 1 linewidth {0} linecolor rgb '{1}'\n"
      "set grid back linetype 1 linewidth {2} linecolor rgb '#dddddd'\n"
      "set tics nomirror out scale 0.5 textcolor rgb '{1}'\n"
      "set format '%g'\nset key noenhanced textcolor rgb '{1}'\n"
      "set tmargin at screen {3}\nset bmargin at screen {4}\n",
      kAxis, kInk, kGrid, 1 - margins.above / sheet.height_mm, margins.below / sheet.height_mm);
  if (!sheet.title.empty())
    script += fmt::format("set label {} at graph 0, screen {} left textcolor rgb '{}'\n",
                          broken(sheet.title, sheet.width_mm - kTitleFrom, kText).literal,
                          1 - (1 + kRow / 2) / sheet.height_mm, kInk);
  return script;
}

namespace {

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

/// gnuplot counts in pixels, and gives everything a title that is nobody's.
std::string finished_svg(std::string text, double width, double height) {
  const std::size_t size = text.find(" width="), end = text.find('\n', size);
  if (size < end && end != std::string::npos)
    text.replace(size, end - size, fmt::format(" width=\"{:g}mm\" height=\"{:g}mm\"", width, height));
  for (std::size_t at = text.find("<title>"); at != std::string::npos; at = text.find("<title>", at))
    text.erase(at, text.find("</title>", at) + 8 - at);
  replace_all(text, fmt::format("font-family=\"{}\"", kFont),
              fmt::format("font-family=\"{}, Verdana, sans-serif\"", kFont));
  return text;
}

/// cairo writes down when it was.
std::string finished_pdf(std::string bytes) {
  constexpr std::string_view kDate = "/CreationDate (D:", kNever = "19700101000000";
  const std::size_t at = bytes.find(kDate);
  if (at != std::string::npos) bytes.replace(at + kDate.size(), kNever.size(), kNever);
  return bytes;
}

}  // namespace

void draw_into(const std::filesystem::path& file, double width, double height, const std::string& script) {
  const Terminal& terminal = terminal_for(file);
  std::string bytes = gnuplot(set_terminal(terminal, width, height) + script);
  if (terminal.name == "svg") bytes = finished_svg(std::move(bytes), width, height);
  if (terminal.name == "pdfcairo") bytes = finished_pdf(std::move(bytes));
  write_file(file, bytes);
}

}  // namespace relock::figure
