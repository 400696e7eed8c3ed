#include "cli/plot/sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "cli/files.h"
#include "cli/plot/gnuplot.h"
#include "cli/plot/look.h"
#include "core/error.h"

namespace relock::figure {
namespace {

constexpr std::string_view kFont = "DejaVu Sans";
constexpr double kRow = 3.9;        // mm, from one line of text to the next
constexpr double kLegendRow = 4.9;  // mm, likewise in a legend: what gnuplot's widest terminal takes, SVG
constexpr double kTitleFrom = 18;   // mm that the title cannot have, about: left of the panel

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

struct Margins {
  double above, below;  ///< mm
};
Margins margins_of(const Sheet& sheet) {
  const Lines title = broken(sheet.title, sheet.width_mm - kTitleFrom, kText);
  const double above = sheet.title.empty() ? 3 : 2.5 + static_cast<double>(title.count) * kRow;
  // With less than 12 mm gnuplot finds no room for an axis' title in an SVG, and leaves it out without a word.
  const double legend = sheet.rows_below > 0 ? 2.5 + static_cast<double>(sheet.rows_below) * kLegendRow : 0;
  return {above, 12.5 + legend};
}

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

Legend legend_for(const std::vector<std::string>& names, double width, double height) {
  if (names.empty()) return {"unset key\n"};
  double longest = 0;
  for (const std::string& name : names) longest = std::max(longest, width_mm(name, kText));
  const double rows_beside = (height - 20) / kRow;
  if (longest > .3 * width || static_cast<double>(names.size()) > rows_beside)
    return legend_below(names, width);
  return {"set key outside right top vertical Left reverse samplen 3 spacing 1.15\n"};
}

Legend legend_below(const std::vector<std::string>& names, double width) {
  if (names.empty()) return {"unset key\n"};
  double longest = 0;
  for (const std::string& name : names) longest = std::max(longest, width_mm(name, kText));
  constexpr double kSample = 12;  // mm, with the room around it
  const auto columns =
      std::clamp<std::size_t>(static_cast<std::size_t>(width / (1.05 * longest + kSample)), 1, names.size());
  const std::size_t rows = (names.size() + columns - 1) / columns;
  // Vertical, because horizontally gnuplot makes no use of the room beside the panel.
  return {fmt::format(
              "set key at screen 0.5, screen 0.01 center bottom vertical maxrows {} Left reverse samplen 3 "
              "spacing 1.15\n",
              rows),
          rows};
}

double least_panel_mm(const Legend& legend) {
  // gnuplot makes no more rows of a legend than would fit beside the panel, with room to spare, and drops
  // names for which the columns then have no room.
  return std::max(20., (static_cast<double>(legend.rows_below) + 2) * kRow * 1.4);
}

double margins_mm(const Sheet& sheet) {
  const Margins margins = margins_of(sheet);
  return margins.above + margins.below;
}

double above_mm(const Sheet& sheet) { return margins_of(sheet).above; }

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

void draw_into(const std::filesystem::path& file, double width, double height, const std::string& script) {
  const Terminal& terminal = terminal_for(file);
  std::string bytes = gnuplot(set_terminal(terminal, width, height) + script);
  if (terminal.name == "svg") bytes = finished_svg(std::move(bytes), width, height);
  if (terminal.name == "pdfcairo") bytes = finished_pdf(std::move(bytes));
  write_file(file, bytes);
}

}  // namespace relock::figure
