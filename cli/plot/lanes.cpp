// Rows of stretches over a common axis of time.

#include <fmt/format.h>

#include <cmath>

#include "cli/plot/look.h"
#include "core/error.h"

namespace relock {
namespace {

using namespace figure;

constexpr std::size_t kLongestName = 48;  // letters

/// Share of its lane that the i-th kind of stretch is high: kinds are told apart without their colours, too.
double height_of(std::size_t kind) {
  constexpr std::array<double, 3> kHeights{.72, .44, .2};
  return kHeights[kind % kHeights.size()];
}

std::string lane_name(const std::string& name) {
  std::string label;
  for (const char c : literal(name)) label += c == '%' ? "%%" : std::string(1, c);  // a label is a format
  return label;
}

class Lanes {
 public:
  explicit Lanes(const LanePlot& plot) : plot_(plot), blocks_(plot.kinds.size()) {
    for (std::size_t i = 0; i < plot.lanes.size(); ++i)
      for (const LaneStretch& stretch : plot.lanes[i].stretches) add(i, stretch);
  }

  std::string script() const {
    std::string data;
    std::vector<std::string> parts{"NaN notitle"}, legend;
    for (std::size_t kind = 0; kind < blocks_.size(); ++kind) {
      const std::string ink = fmt::format("linecolor rgb '{}'", colour(kind));
      if (!blocks_[kind].empty()) {
        data += fmt::format("$d{} << END\n{}END\n", kind, blocks_[kind]);
        parts.push_back(fmt::format(
            "$d{} using 1:2:3:4:5:6 with boxxyerror fillstyle solid 1 border linewidth .3 {} notitle", kind,
            ink));
      }
      legend.push_back(fmt::format("keyentry with lines linewidth {} {} title {}",
                                   height_of(kind) * .45 * plot_.lane_mm / 25.4 * 72, ink,
                                   literal(plot_.kinds[kind])));
    }
    parts.insert(parts.end(), legend.begin(), legend.end());
    return data + axis("x", plot_.x, x_, .8 * plot_.width_mm) + rows() +
           "set key outside bottom center horizontal Left reverse samplen 2 width 2\n" +
           fmt::format("plot {}\n", fmt::join(parts, ", \\\n     "));
  }

 private:
  void add(std::size_t lane, const LaneStretch& stretch) {
    if (stretch.kind >= blocks_.size())
      throw Error(
          fmt::format("a stretch of a plot is of kind {}, and there are {}", stretch.kind, blocks_.size()));
    if (!std::isfinite(stretch.from) || !std::isfinite(stretch.to)) return;
    const double row = static_cast<double>(lane), half = height_of(stretch.kind) / 2;
    blocks_[stretch.kind] += fmt::format("{} {} {} {} {} {}\n", stretch.from, row, stretch.from, stretch.to,
                                         row - half, row + half);
    x_.add(stretch.from), x_.add(stretch.to);
  }

  std::string rows() const {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < plot_.lanes.size(); ++i)
      names.push_back(fmt::format("{} {}", lane_name(plot_.lanes[i].name), i));
    return fmt::format("set yrange [{}:-0.5]\nset ytics scale 0 ({})\nset grid x noy\nset border 1\n",
                       std::max<double>(static_cast<double>(names.size()), 1) - .5, fmt::join(names, ", "));
  }

  const LanePlot& plot_;
  std::vector<std::string> blocks_;  // of each kind
  Extent x_;
};

}  // namespace

void draw(const LanePlot& plot, const std::filesystem::path& file) {
  constexpr double kAround = 22;  // mm: title, axis and legend
  const double height = plot.lane_mm * std::max<double>(static_cast<double>(plot.lanes.size()), 1) + kAround;
  figure::draw_into(file, plot.width_mm, height, plot.title, Lanes(plot).script());
}

}  // namespace relock
