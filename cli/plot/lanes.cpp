// Rows of stretches over a common axis of time.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "cli/plot/look.h"
#include "cli/plot/sheet.h"
#include "cli/terminal.h"
#include "core/error.h"

namespace relock {
namespace {

using namespace figure;

constexpr std::size_t kLongestName = 40;  // letters
constexpr double kThinnest = 1. / 2000;   // of the axis: what is shorter is drawn as long as this

constexpr double kPanelOfBars = 12, kBetweenPanels = 2;  // mm
constexpr double kLeastLane = 2.5;                       // mm: names are 2.8 high

/// Without a look of its own a kind has one of three heights: kinds are told apart without their colours, too.
LaneLook look_of(const LanePlot& plot, std::size_t kind) {
  if (!plot.looks.empty()) return plot.looks[kind];
  constexpr std::array<double, 3> kHeights{.76, .46, .2};
  const double half = kHeights[kind % kHeights.size()] / 2;
  return {std::string(colour(kind)), -half, half};
}

std::string shortened(const std::string& name) {
  if (columns_of(name) <= kLongestName) return name;
  std::size_t end = 0;
  for (std::size_t letters = 0; letters < kLongestName; ++letters) do
      ++end;
    while (end < name.size() && (static_cast<unsigned char>(name[end]) & 0xc0) == 0x80);
  return name.substr(0, end) + "…";
}

bool is_drawn(const LaneStretch& stretch) { return std::isfinite(stretch.from) && std::isfinite(stretch.to); }

Extent extent_of(const LanePlot& plot) {
  Extent all;
  for (const PlotLane& lane : plot.lanes)
    for (const LaneStretch& stretch : lane.stretches)
      if (std::isfinite(stretch.from) && std::isfinite(stretch.to))
        all.add(stretch.from), all.add(stretch.to);
  for (const LaneBar& bar : plot.above) all.add(bar.from), all.add(bar.to);
  return all;
}

/// A lane's stretches of one kind; those that follow each other without a gap are one, for where two meet a
/// drawing shows a seam.
std::vector<LaneStretch> joined(const PlotLane& lane, std::size_t kind) {
  std::vector<LaneStretch> all;
  for (const LaneStretch& stretch : lane.stretches) {
    if (stretch.kind != kind || !is_drawn(stretch)) continue;
    if (!all.empty() && all.back().from <= stretch.from && stretch.from <= all.back().to) {
      all.back().to = std::max(all.back().to, stretch.to);
    } else {
      all.push_back(stretch);
    }
  }
  return all;
}

/// The stretches of one kind, as gnuplot reads boxes.
std::string boxes_of(const LanePlot& plot, std::size_t kind, double thinnest) {
  std::string text;
  const LaneLook look = look_of(plot, kind);
  for (std::size_t row = 0; row < plot.lanes.size(); ++row)
    for (const LaneStretch& stretch : joined(plot.lanes[row], kind)) {
      const double y = static_cast<double>(row),
                   missing = std::max(thinnest - (stretch.to - stretch.from), 0.);
      text += fmt::format("{0} {1} {0} {2} {3} {4}\n", stretch.from - missing / 2, y,
                          stretch.to + missing / 2, y - look.high, y - look.low);
    }
  return text;
}

void check_kinds(const LanePlot& plot) {
  if (!plot.looks.empty() && plot.looks.size() != plot.kinds.size())
    throw Error(
        fmt::format("a plot names {} kinds and {} looks of them", plot.kinds.size(), plot.looks.size()));
  for (const PlotLane& lane : plot.lanes)
    for (const LaneStretch& stretch : lane.stretches)
      if (stretch.kind >= plot.kinds.size())
        throw Error(fmt::format("a stretch of \"{}\" is of kind {}, and the plot names {} kinds", lane.name,
                                stretch.kind, plot.kinds.size()));
}

/// Share of the sheet's width that is left of the lanes: their names, or an axis of numbers and its title.
double left_share(const LanePlot& plot) {
  double widest = plot.above.empty() ? 0 : 8;
  for (const PlotLane& lane : plot.lanes) widest = std::max(widest, width_mm(shortened(lane.name), kText));
  return std::min((widest + 4) / plot.width_mm, .6);
}

/// Share of it where they end.
double right_share(const LanePlot& plot) { return 1 - 5 / plot.width_mm; }

/// The smallest of 1, 2, 5 times a power of ten that is at least `least`.
double round_step(double least) {
  const double power = std::pow(10, std::floor(std::log10(least)));
  for (const double factor : {1., 2., 5.})
    if (factor * power >= least) return factor * power;
  return 10 * power;
}

/// Marks on the axis of time, so far apart that their numbers do not touch on a narrow sheet.
std::string marks(const LanePlot& plot, double shown) {
  constexpr double kApart = 7.5;  // mm
  const double panel = plot.width_mm * (right_share(plot) - left_share(plot));
  return plot.x.logarithmic ? "" : fmt::format("set xtics {}\n", round_step(shown * kApart / panel));
}

/// The lanes' names, and room for them.
std::string rows_of(const LanePlot& plot) {
  std::vector<std::string> labels;
  for (std::size_t i = 0; i < plot.lanes.size(); ++i) {
    const std::string name = shortened(plot.lanes[i].name);
    std::string label;
    for (const char c : literal(name)) label += c == '%' ? "%%" : std::string(1, c);  // a label is a format
    labels.push_back(fmt::format("{} {}", label, i));
  }
  return fmt::format("set yrange [{}:-0.5]\nset ytics scale 0 ({})\nset grid noytics\nset border 1\n",
                     std::max<double>(static_cast<double>(labels.size()), 1) - .5, fmt::join(labels, ", ")) +
         fmt::format("set lmargin at screen {}\nset rmargin at screen {}\n", left_share(plot),
                     right_share(plot));
}

std::string plotted(const LanePlot& plot, double thinnest, double lane_mm) {
  std::string data;
  std::vector<std::string> parts{"NaN notitle"}, names;
  for (std::size_t kind = 0; kind < plot.kinds.size(); ++kind) {
    const std::string ink = fmt::format("linecolor rgb '{}'", look_of(plot, kind).colour);
    const std::string boxes = boxes_of(plot, kind, thinnest);
    if (!boxes.empty()) {
      data += fmt::format("$d{} << END\n{}END\n", kind, boxes);
      parts.push_back(fmt::format("$d{} with boxxyerror fillstyle solid 1 noborder {} notitle", kind, ink));
    }
    const LaneLook look = look_of(plot, kind);
    const double high = (look.high - look.low) * std::min(lane_mm, 4.) / 25.4 * 72;
    names.push_back(fmt::format("keyentry with lines linewidth {:.2f} {} title {}", high, ink,
                                literal(plot.kinds[kind])));
  }
  parts.insert(parts.end(), names.begin(), names.end());
  return data + fmt::format("plot {}\n", fmt::join(parts, ", \\\n     "));
}

/// Room over the lanes.
double bars_mm(const LanePlot& plot) { return plot.above.empty() ? 0 : kPanelOfBars + kBetweenPanels; }

/// The panel of bars, at the head of the sheet. What it sets for itself it sets back.
std::string bars(const LanePlot& plot, const Sheet& whole, double above_mm) {
  double highest = 0;
  std::string data;
  for (const LaneBar& bar : plot.above) {
    if (!std::isfinite(bar.value) || bar.value < 0) continue;
    highest = std::max(highest, bar.value);
    data += fmt::format("{0} 0 {0} {1} 0 {2}\n", bar.from, bar.to, bar.value);
  }
  const double step = round_step(std::max(highest, 1e-3) / 2);
  const double top = 1 - above_mm / whole.height_mm, foot = top - kPanelOfBars / whole.height_mm;
  return fmt::format(
             "set multiplot\n$above << END\n{}END\nunset key\nset tmargin at screen {}\nset bmargin at "
             "screen {}\n"
             "set border 2\nset grid noxtics ytics\nset xtics scale 0 format ''\n"
             "set yrange [0:{}]\nset ytics {}\nset ylabel {} textcolor rgb '{}'\n",
             data, top, foot, std::max(highest, step) * 1.05, step, literal(plot.above_title), kInk) +
         fmt::format(
             "plot $above with boxxyerror fillstyle solid 1 border linewidth 0.3 linecolor rgb '#555555' "
             "notitle\n"
             "unset label\nunset ylabel\nset grid xtics\nset xtics scale 0.5 format '%g'\nset tmargin at "
             "screen {}\n"
             "set bmargin at screen {}\n",
             foot - kBetweenPanels / whole.height_mm, (margins_mm(whole) - above_mm) / whole.height_mm);
}

/// How high a lane is: as high as fits the sheet that is asked for. Throws Error when all of them do not.
double lane_height(const LanePlot& plot, const Legend& legend, double around_mm) {
  const auto lanes = std::max<double>(static_cast<double>(plot.lanes.size()), 1);
  const double least = legend.rows_below > 1 ? least_panel_mm(legend) : 0;
  if (!plot.height_mm) return std::max(plot.lane_mm, least / lanes);
  const double fits = *plot.height_mm - around_mm;
  if (fits < std::max(lanes * kLeastLane, least))
    throw Error(fmt::format("{} lanes and their legend need a figure of {:.0f} mm height or more, not {:g}",
                            plot.lanes.size(), std::ceil(around_mm + std::max(lanes * kLeastLane, least)),
                            *plot.height_mm));
  return fits / lanes;
}

}  // namespace

void draw(const LanePlot& plot, const std::filesystem::path& file) {
  check_kinds(plot);
  const Legend legend = legend_below(plot.kinds, plot.width_mm);
  const Sheet without{plot.title, plot.width_mm, 0, legend.rows_below};
  const double around = margins_mm(without) + bars_mm(plot);
  const double lane_mm = lane_height(plot, legend, around);
  const double lanes = std::max<double>(static_cast<double>(plot.lanes.size()), 1) * lane_mm;
  const Sheet whole{plot.title, plot.width_mm, lanes + around, legend.rows_below};
  const Extent extent = extent_of(plot);
  PlotAxis x = plot.x;  // time begins and ends with the data, not at the next round number
  if (extent.low && *extent.low < *extent.high) {
    x.low = x.low.value_or(*extent.low);
    x.high = x.high.value_or(*extent.high);
  }
  const double shown = x.low && x.high ? *x.high - *x.low : 1;
  std::string script = sheet(whole);
  // The panel of bars shares the axis of time, but not its title, and the room for the lanes' names.
  const std::string rows = rows_of(plot) + marks(plot, shown);
  if (!plot.above.empty()) {
    PlotAxis untitled = x;
    untitled.title.clear();
    script += axis("x", untitled, extent) + rows + bars(plot, whole, above_mm(whole));
  }
  script += legend.script + axis("x", x, extent) + rows + plotted(plot, kThinnest * shown, lane_mm);
  figure::draw_into(file, whole.width_mm, whole.height_mm, script);
}

}  // namespace relock
