// Curves over a common axis.

#include <fmt/format.h>

#include <cmath>

#include "cli/plot/look.h"

namespace relock {
namespace {

using namespace figure;

constexpr std::size_t kMostMarks = 60;  // more points on a line than this are marked now and then only

bool has_place(const PlotAxis& axis, double value) {
  return std::isfinite(value) && (!axis.logarithmic || value > 0);
}

/// A curve's points as gnuplot reads them: an empty line is a break.
struct CurveData {
  std::string points;
  std::string lone;  ///< points without a neighbour, which are no line
  std::string whiskers;
  std::size_t drawn = 0;
};

class Curves {
 public:
  explicit Curves(const Plot& plot) : plot_(plot) {}

  std::string script() {
    std::size_t ours = 0, published = 0;
    for (const PlotCurve& curve : plot_.curves)
      add(curve, curve.published ? published_look(published++) : curve_look(ours++));
    if (!x_.low) behind_.emplace_back("NaN notitle");
    const std::string data = std::move(data_);
    return data + axis("x", plot_.x, x_, .8 * plot_.width_mm) + axis("y", plot_.y, y_, .8 * plot_.height_mm) +
           legend() + nothing() + fmt::format("plot {}\n", fmt::join(all(), ", \\\n     "));
  }

 private:
  bool drawable(const PlotPoint& point) const {
    return has_place(plot_.x, point.x) && has_place(plot_.y, point.y);
  }

  CurveData data_of(const PlotCurve& curve) {
    CurveData data;
    const auto& points = curve.points;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const PlotPoint& point = points[i];
      if (!drawable(point)) {
        data.points += "\n";
        continue;
      }
      const std::string place = fmt::format("{} {}\n", point.x, point.y);
      const bool alone =
          (i == 0 || !drawable(points[i - 1])) && (i + 1 == points.size() || !drawable(points[i + 1]));
      data.points += place;
      if (alone) data.lone += place;
      ++data.drawn;
      x_.add(point.x), y_.add(point.y);
      if (point.interval) add_whisker(point, data);
    }
    return data;
  }

  void add_whisker(const PlotPoint& point, CurveData& data) {
    const double low = point.interval->low, high = point.interval->high;
    if (!has_place(plot_.y, high) || !std::isfinite(low)) return;  // it has no end
    // On a logarithmic axis nothing is at 0: the whisker goes as far down as the point is from its upper end.
    const double end = has_place(plot_.y, low) ? low : point.y * point.y / high;
    data.whiskers += fmt::format("{} {} {} {}\n", point.x, point.y, end, high);
    y_.add(end), y_.add(high);
  }

  void add(const PlotCurve& curve, const CurveLook& look) {
    const CurveData data = data_of(curve);
    auto& layer = curve.published ? behind_ : before_;
    const auto part = [&](const std::string& content, const std::string& how) {
      if (content.empty()) return;
      data_ += fmt::format("$d{} << END\n{}END\n", ++blocks_, content);
      layer.push_back(fmt::format("$d{} {} notitle", blocks_, how));
    };
    const bool line = curve.style != CurveStyle::points, marks = curve.style != CurveStyle::line;
    const std::string way = line && marks ? "linespoints" : line ? "lines" : "points";
    std::string how = fmt::format("with {} {}", way, look.line);
    if (marks) how += " " + look.points;
    const std::size_t step = data.drawn > kMostMarks ? data.drawn / (kMostMarks / 2) : 1;
    part(data.whiskers,
         fmt::format("with yerrorbars pointtype 7 pointsize 0 dashtype solid linewidth {} linecolor rgb '{}'",
                     kWhisker, look.colour));
    if (data.drawn > 0)
      part(data.points, line && marks && step > 1 ? fmt::format("{} pointinterval {}", how, step) : how);
    if (!marks)
      part(data.lone, fmt::format("with points pointtype 7 pointsize .25 linecolor rgb '{}'", look.colour));
    if (curve.name.empty()) return;
    legend_.push_back(fmt::format("keyentry {} title {}", how, literal(curve.name)));
    longest_ = std::max(longest_, width_mm(curve.name, kText));
  }

  std::string legend() const {
    // Beside the panel; below it when names are so long that they would take the panel's place.
    const bool beside = longest_ < .3 * plot_.width_mm;
    return fmt::format("set key {} Left reverse samplen 3 spacing 1.2 width 1\n",
                       beside ? "outside right top vertical" : "outside bottom center horizontal");
  }

  std::string nothing() const {
    if (x_.low) return "";
    return fmt::format("set label 'no data' at graph .5, graph .5 center textcolor rgb '{}'\n", kGrey);
  }

  std::vector<std::string> all() const {
    std::vector<std::string> parts = behind_;
    parts.insert(parts.end(), before_.begin(), before_.end());
    parts.insert(parts.end(), legend_.begin(), legend_.end());
    return parts;
  }

  const Plot& plot_;
  Extent x_, y_;
  std::string data_;
  std::size_t blocks_ = 0;
  std::vector<std::string> behind_, before_, legend_;
  double longest_ = 0;  // mm
};

}  // namespace

void draw(const Plot& plot, const std::filesystem::path& file) {
  figure::draw_into(file, plot.width_mm, plot.height_mm, plot.title, Curves(plot).script());
}

}  // namespace relock
