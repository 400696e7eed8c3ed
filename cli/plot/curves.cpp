// Curves over a common axis.

#include <fmt/format.h>

#include <cmath>

#include "cli/plot/look.h"
#include "cli/plot/sheet.h"

namespace relock {
namespace {

using namespace figure;

constexpr std::size_t kMostMarks = 60;  // a line with more points than this is marked now and then only

bool has_place(const PlotAxis& axis, double value) {
  return std::isfinite(value) && (!axis.logarithmic || value > 0);
}
bool has_place(const Plot& plot, const PlotPoint& point) {
  return has_place(plot.x, point.x) && has_place(plot.y, point.y);
}
/// An interval without an upper end says nothing that could be drawn.
bool has_whisker(const Plot& plot, const PlotPoint& point) {
  return has_place(plot, point) && point.interval && has_place(plot.y, point.interval->high) &&
         std::isfinite(point.interval->low);
}

struct Extents {
  Extent x, y;
};
Extents extents_of(const Plot& plot) {
  Extents all;
  for (const PlotCurve& curve : plot.curves)
    for (const PlotPoint& point : curve.points) {
      if (!has_place(plot, point)) continue;
      all.x.add(point.x), all.y.add(point.y);
      if (!has_whisker(plot, point)) continue;
      all.y.add(point.interval->high);
      if (has_place(plot.y, point.interval->low)) all.y.add(point.interval->low);
    }
  // Where whiskers end that go down to 0, which a logarithmic axis does not have.
  if (plot.y.logarithmic && all.y.low) all.y.low = std::pow(10, std::floor(std::log10(*all.y.low)));
  return all;
}

/// A curve's points as gnuplot reads them: an empty line is a break.
std::string points_of(const Plot& plot, const PlotCurve& curve) {
  std::string text;
  for (const PlotPoint& point : curve.points)
    text += has_place(plot, point) ? fmt::format("{} {}\n", point.x, point.y) : "\n";
  return text;
}

/// Those without a neighbour, which no line shows.
std::string lone_points_of(const Plot& plot, const PlotCurve& curve) {
  std::string text;
  const auto& points = curve.points;
  const auto drawn = [&](std::size_t i) { return i < points.size() && has_place(plot, points[i]); };
  for (std::size_t i = 0; i < points.size(); ++i)
    if (drawn(i) && !drawn(i + 1) && !(i > 0 && drawn(i - 1)))
      text += fmt::format("{} {}\n", points[i].x, points[i].y);
  return text;
}

std::string whiskers_of(const Plot& plot, const PlotCurve& curve, double bottom) {
  std::string text;
  for (const PlotPoint& point : curve.points) {
    if (!has_whisker(plot, point)) continue;
    const double low = has_place(plot.y, point.interval->low) ? point.interval->low : bottom;
    text += fmt::format("{} {} 0 {}\n", point.x, low, point.interval->high - low);
  }
  return text;
}

/// What is plotted, from the back to the front.
class Layers {
 public:
  explicit Layers(const Plot& plot, const Extents& extents)
      : plot_(plot), bottom_(plot.y.low.value_or(extents.y.low.value_or(0))) {
    std::size_t ours = 0, published = 0;
    for (const PlotCurve& curve : plot.curves)
      if (curve.published) names_.push_back(add(curve, published_look(published++)));
    std::vector<std::string> names;
    for (const PlotCurve& curve : plot.curves)
      if (!curve.published) names.push_back(add(curve, curve_look(ours++)));
    names_.insert(names_.begin(), names.begin(), names.end());
  }

  std::string script() const {
    std::vector<std::string> all{"NaN notitle"};  // so that there is something to plot
    all.insert(all.end(), parts_.begin(), parts_.end());
    for (const std::string& name : names_)
      if (!name.empty()) all.push_back(name);
    return data_ + fmt::format("plot {}\n", fmt::join(all, ", \\\n     "));
  }

 private:
  /// Adds a curve; returns its line in the legend.
  std::string add(const PlotCurve& curve, const CurveLook& look) {
    const bool line = curve.style != CurveStyle::points, marks = curve.style != CurveStyle::line;
    std::string how = line && marks ? "with linespoints " : line ? "with lines " : "with points ";
    how += look.line;
    if (marks) how += " " + look.points;
    put(whiskers_of(plot_, curve, bottom_),
        fmt::format("with vectors heads size screen .004,90 linetype 1 linewidth {} linecolor rgb '{}'",
                    kWhisker, look.colour));
    const bool crowded = line && marks && curve.points.size() > kMostMarks;
    put(points_of(plot_, curve),
        how + (crowded ? fmt::format(" pointinterval {}", curve.points.size() * 2 / kMostMarks) : ""));
    if (!marks)
      put(lone_points_of(plot_, curve),
          fmt::format("with points pointtype 7 pointsize .3 * mark linecolor rgb '{}'", look.colour));
    return curve.name.empty() ? "" : fmt::format("keyentry {} title {}", how, literal(curve.name));
  }

  void put(const std::string& content, const std::string& how) {
    if (content.find_first_not_of('\n') == std::string::npos) return;
    data_ += fmt::format("$d{} << END\n{}END\n", parts_.size(), content);
    parts_.push_back(fmt::format("$d{} {} notitle", parts_.size(), how));
  }

  const Plot& plot_;
  double bottom_;
  std::string data_;
  std::vector<std::string> parts_, names_;
};

Legend legend_of(const Plot& plot) {
  std::vector<std::string> names;
  for (const PlotCurve& curve : plot.curves)
    if (!curve.name.empty()) names.push_back(curve.name);
  return legend_for(names, plot.width_mm, plot.height_mm);
}

}  // namespace

void draw(const Plot& plot, const std::filesystem::path& file) {
  const Legend legend = legend_of(plot);
  Sheet paper{plot.title, plot.width_mm, plot.height_mm, legend.rows_below};
  paper.height_mm = std::max(paper.height_mm, margins_mm(paper) + least_panel_mm(legend));
  const Extents extents = extents_of(plot);
  std::string script =
      sheet(paper) + legend.script + axis("x", plot.x, extents.x) + axis("y", plot.y, extents.y);
  if (!extents.x.low)
    script += fmt::format("set label 'no data' at graph .5, graph .5 center textcolor rgb '{}'\n", kGrey);
  draw_into(file, paper.width_mm, paper.height_mm, script + Layers(plot, extents).script());
}

}  // namespace relock
