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

/// Share of its lane that the i-th kind of stretch is high: kinds are told apart without their colours, too.
double height_of(std::size_t kind) {
  constexpr std::array<double, 3> kHeights{.76, .46, .2};
  return kHeights[kind % kHeights.size()];
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
  const double half = height_of(kind) / 2;
  for (std::size_t row = 0; row < plot.lanes.size(); ++row)
    for (const LaneStretch& stretch : joined(plot.lanes[row], kind)) {
      const double y = static_cast<double>(row),
                   missing = std::max(thinnest - (stretch.to - stretch.from), 0.);
      text += fmt::format("{0} {1} {0} {2} {3} {4}\n", stretch.from - missing / 2, y,
                          stretch.to + missing / 2, y - half, y + half);
    }
  return text;
}

void check_kinds(const LanePlot& plot) {
  for (const PlotLane& lane : plot.lanes)
    for (const LaneStretch& stretch : lane.stretches)
      if (stretch.kind >= plot.kinds.size())
        throw Error(fmt::format("a stretch of \"{}\" is of kind {}, and the plot names {} kinds", lane.name,
                                stretch.kind, plot.kinds.size()));
}

/// The lanes' names, and room for them.
std::string rows_of(const LanePlot& plot) {
  std::vector<std::string> labels;
  double widest = 0;
  for (std::size_t i = 0; i < plot.lanes.size(); ++i) {
    const std::string name = shortened(plot.lanes[i].name);
    std::string label;
    for (const char c : literal(name)) label += c == '%' ? "%%" : std::string(1, c);  // a label is a format
    labels.push_back(fmt::format("{} {}", label, i));
    widest = std::max(widest, width_mm(name, kText));
  }
  return fmt::format("set yrange [{}:-0.5]\nset ytics scale 0 ({})\nset grid noytics\nset border 1\n",
                     std::max<double>(static_cast<double>(labels.size()), 1) - .5, fmt::join(labels, ", ")) +
         fmt::format("set lmargin at screen {}\nset rmargin at screen {}\n",
                     std::min((widest + 4) / plot.width_mm, .6), 1 - 5 / plot.width_mm);
}

std::string plotted(const LanePlot& plot, double thinnest) {
  std::string data;
  std::vector<std::string> parts{"NaN notitle"}, names;
  for (std::size_t kind = 0; kind < plot.kinds.size(); ++kind) {
    const std::string ink = fmt::format("linecolor rgb '{}'", colour(kind));
    const std::string boxes = boxes_of(plot, kind, thinnest);
    if (!boxes.empty()) {
      data += fmt::format("$d{} << END\n{}END\n", kind, boxes);
      parts.push_back(fmt::format("$d{} with boxxyerror fillstyle solid 1 noborder {} notitle", kind, ink));
    }
    const double high = height_of(kind) * std::min(plot.lane_mm, 4.) / 25.4 * 72;
    names.push_back(fmt::format("keyentry with lines linewidth {:.2f} {} title {}", high, ink,
                                literal(plot.kinds[kind])));
  }
  parts.insert(parts.end(), names.begin(), names.end());
  return data + fmt::format("plot {}\n", fmt::join(parts, ", \\\n     "));
}

}  // namespace

void draw(const LanePlot& plot, const std::filesystem::path& file) {
  check_kinds(plot);
  const Legend legend = legend_below(plot.kinds, plot.width_mm);
  double lanes = std::max<double>(static_cast<double>(plot.lanes.size()), 1) * plot.lane_mm;
  if (legend.rows_below > 1) lanes = std::max(lanes, least_panel_mm(legend));
  const Sheet without{plot.title, plot.width_mm, 0, legend.rows_below};
  const Sheet whole{plot.title, plot.width_mm, lanes + margins_mm(without), legend.rows_below};
  const Extent extent = extent_of(plot);
  PlotAxis x = plot.x;  // time begins and ends with the data, not at the next round number
  if (extent.low && *extent.low < *extent.high) {
    x.low = x.low.value_or(*extent.low);
    x.high = x.high.value_or(*extent.high);
  }
  const double shown = x.low && x.high ? *x.high - *x.low : 1;
  figure::draw_into(
      file, whole.width_mm, whole.height_mm,
      sheet(whole) + legend.script + axis("x", x, extent) + rows_of(plot) + plotted(plot, kThinnest * shown));
}

}  // namespace relock
