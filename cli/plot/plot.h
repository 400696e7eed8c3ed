#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "eval/statistics/interval.h"

// Figures of the program, all with one look. gnuplot draws them.

namespace relock {

struct PlotPoint {
  double x = 0, y = 0;
  std::optional<Interval> interval = {};  ///< of y, drawn as a whisker
};

enum class CurveStyle : std::uint8_t { line, points, points_on_line };

struct PlotCurve {
  std::string name = {};  ///< in the legend; empty: it is not there
  std::vector<PlotPoint> points = {};
  CurveStyle style = CurveStyle::points_on_line;
  bool published = false;  ///< somebody else's figures, drawn dashed and grey
};

struct PlotAxis {
  std::string title = {};                     ///< with its unit
  std::optional<double> low = {}, high = {};  ///< else what the data need
  bool logarithmic = false;
};

/// Curves over a common axis. A point that is not finite, or has no place on a logarithmic axis, is left out and
/// breaks its line. Of more than 60 points on a line only some are marked. The legend stands beside the panel,
/// or below it when names are long or many; then the sheet grows if it must.
struct Plot {
  std::string title = {};
  PlotAxis x = {}, y = {};
  std::vector<PlotCurve> curves = {};
  double width_mm = 120, height_mm = 80;
};

/// A stretch of a lane, in the unit of the axis.
struct LaneStretch {
  double from = 0, to = 0;
  std::size_t kind = 0;  ///< which of the plot's
};
struct PlotLane {
  std::string name = {};
  std::vector<LaneStretch> stretches = {};
};
/// How one kind of stretch looks: its colour, and from where to where it fills its lane, -0.5 (foot) to 0.5 (head).
struct LaneLook {
  std::string colour;  ///< "#0072b2"
  double low = 0, high = 0;
};
/// Over all lanes: how much there was of something, from when to when.
struct LaneBar {
  double from = 0, to = 0;
  double value = 0;  ///< 0 or more
};
/// Rows of stretches over a common axis of time: who was where, when. Kinds differ in height, too. A stretch
/// that is too short to be seen is drawn as a hairline.
struct LanePlot {
  std::string title = {};
  PlotAxis x = {};
  std::vector<std::string> kinds = {};  ///< of stretches, with a colour each, in the legend
  std::vector<PlotLane> lanes = {};     ///< from the top
  double width_mm = 180, lane_mm = 7;
  std::optional<double> height_mm =
      {};  ///< of the sheet; then lanes are as high as fits, and lane_mm says nothing
  std::vector<LaneLook> looks = {};  ///< of each kind; else colours and heights in turn
  std::vector<LaneBar> above = {};   ///< a panel of bars over the lanes
  std::string above_title = {};      ///< with its unit
};

/// Whether plots can be drawn here: gnuplot is installed.
bool can_plot();

/// Draws into `file`, with letters of 8 pt. Its ending says how: .svg, .pdf (fonts embedded) or .png (200 dots per
/// inch). The same plot gives the same bytes. Throws Error on another ending, when nothing can be drawn here, and
/// when the file cannot be written.
void draw(const Plot& plot, const std::filesystem::path& file);
void draw(const LanePlot& plot, const std::filesystem::path& file);

}  // namespace relock
