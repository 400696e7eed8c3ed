#include "cli/map/draw.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/map/canvas.h"

namespace relock::maps {
namespace {

// The page, mm.
constexpr double kPageWidth = 180, kMargin = 3;
constexpr double kLeftOfPanel = 17, kAbovePanel = 8, kBelowPanel = 12.5;  // axis, title, axis
constexpr double kMainRow = 11.5, kMethodRow = 7.5, kLegend = 9;
constexpr double kBarWidth = 3, kBarRoom = 20;  // the colour bar at the right, with its numbers
constexpr double kGutter = 4;

constexpr double kSize = 2.8, kSmallSize = 2.2, kTitleSize = 3.2, kNumberSize = 3.0;  // of letters
constexpr Colour kInk{0, 0, 0}, kFaint{0.35, 0.35, 0.35}, kPaper{1, 1, 1};
constexpr double kHatchSpacing = 1.6, kHatchWidth = 0.18;

/// One grid of cells on the page: rows from the least blur at the bottom up.
struct Panel {
  Rectangle area;
  std::size_t rows, columns;

  double cell_width() const { return area.width / static_cast<double>(columns); }
  double cell_height() const { return area.height / static_cast<double>(rows); }
  Rectangle cell(std::size_t row, std::size_t column) const {
    return {area.x + cell_width() * static_cast<double>(column),
            area.bottom() - cell_height() * static_cast<double>(row + 1), cell_width(), cell_height()};
  }
  /// Where a value of the axis is: columns stand evenly, and between their middles it is linear.
  double x_of(double value, const std::vector<double>& axis) const {
    std::size_t next = 1;
    while (next + 1 < axis.size() && axis[next] < value) ++next;
    const double part = (value - axis[next - 1]) / (axis[next] - axis[next - 1]);
    return area.x + cell_width() * (static_cast<double>(next) - 0.5 + part);
  }
};

/// Whole percent, with a true minus sign; never "-0".
std::string percent(double share) { return fmt::format("{:.0f}", std::abs(std::round(100 * share))); }
std::string signed_percent(double share) {
  const double whole = std::round(100 * share);
  return fmt::format("{}{:.0f}", whole > 0 ? "+" : whole < 0 ? "\u2212" : "", std::abs(whole));
}

std::string period_of_columns(const MeasuredMap& map) {
  return fmt::format("{:.1f} ms", 1000 / map.plan.flight.camera.rate_hz);
}

/// "length of gaps, slots of 33.3 ms (1: no gap)"
std::string column_title(const MeasuredMap& map) {
  if (map.plan.across != Across::gap) return title_of_columns(map.plan.across);
  return fmt::format("length of gaps, slots of {} (1: no gap)", period_of_columns(map));
}

void draw_axes(Canvas& canvas, const MeasuredMap& map, const Panel& panel) {
  for (std::size_t column = 0; column < panel.columns; ++column)
    canvas.text(fmt::format("{:g}", map.plan.columns[column]), panel.cell(0, column).middle_x(),
                panel.area.bottom() + 2.6, kSize, kInk, Anchor::middle);
  canvas.text(column_title(map), panel.area.middle_x(), panel.area.bottom() + 7, kSize, kInk, Anchor::middle);
  for (std::size_t row = 0; row < panel.rows; ++row)
    canvas.text(blur_cell(map, row), panel.area.x - 1.5, panel.cell(row, 0).middle_y(), kSize, kInk,
                Anchor::right);
  canvas.upright_text(title_of_rows(map.plan.across), panel.area.x - 11.5, panel.area.middle_y(), kSize,
                      kInk);
  canvas.frame(panel.area, kInk, 0.25);
}

void draw_title(Canvas& canvas, const Panel& panel, const std::string& title) {
  canvas.text(title, panel.area.x, panel.area.y - 3.2, kTitleSize, kInk, Anchor::left);
}

using Ramp = Colour (*)(double);

/// A colour bar from `low` to `high`, which are labelled in percent.
void draw_bar(Canvas& canvas, const Rectangle& bar, double low, double high, Ramp ramp,
              std::string (*label)(double), const std::string& title) {
  constexpr int kSteps = 64, kLabels = 4;
  for (int step = 0; step < kSteps; ++step) {
    const double part = (step + 0.5) / kSteps, height = bar.height / kSteps;
    // Each reaches under the next, so that no seam shows.
    const double top = bar.bottom() - height * (step + 1);
    canvas.fill({bar.x, top, bar.width, std::min(2 * height, bar.bottom() - top)},
                ramp(low + (high - low) * part));
  }
  canvas.frame(bar, kInk, 0.2);
  for (int i = 0; i <= kLabels; ++i) {
    const double part = static_cast<double>(i) / kLabels;
    canvas.text(label(low + (high - low) * part), bar.right() + 1, bar.bottom() - bar.height * part,
                kSmallSize, kInk, Anchor::left);
  }
  canvas.upright_text(title, bar.right() + 10.5, bar.middle_y(), kSmallSize, kInk);
}

/// Where the lead changes hands, in steps: rows are measured, not what is between them.
void draw_boundary(Canvas& canvas, const MeasuredMap& map, const Answer& answer, const Panel& panel) {
  const auto& axis = map.plan.columns;
  for (std::size_t row = 0; row < panel.rows; ++row) {
    if (!answer.rows[row].boundary) continue;
    const Boundary& boundary = *answer.rows[row].boundary;
    const Rectangle cell = panel.cell(row, 0);
    const double left = boundary.low ? panel.x_of(*boundary.low, axis) : panel.area.x;
    const double right = boundary.high ? panel.x_of(*boundary.high, axis) : panel.area.right();
    canvas.fill({left, cell.y, right - left, cell.height}, kFaint, 0.18);
  }
  for (const auto& [width, colour] : {std::pair{1.6, kPaper}, std::pair{0.8, kInk}}) {
    std::optional<double> below;  // x in the row below
    for (std::size_t row = 0; row < panel.rows; ++row) {
      const auto& boundary = answer.rows[row].boundary;
      const Rectangle cell = panel.cell(row, 0);
      const auto x = boundary ? std::optional(panel.x_of(boundary->at, axis)) : std::nullopt;
      if (x) canvas.line(*x, cell.y, *x, cell.bottom(), colour, width);
      if (x && below) canvas.line(*below, cell.bottom(), *x, cell.bottom(), colour, width);
      below = x;
    }
  }
}

std::string half_width(const Estimate& estimate) {
  const Interval interval = estimate.interval();
  const double half = (interval.high - interval.low) / 2;
  return std::isfinite(half) ? fmt::format("\u00b1{:.0f}", 100 * half) : "\u00b1?";
}

/// A cell whose flights never see the target: it has no colour.
void draw_nothing(Canvas& canvas, const Rectangle& cell) {
  canvas.text("n/a", cell.middle_x(), cell.middle_y(), kSmallSize, kInk, Anchor::middle);
}

void draw_contest(Canvas& canvas, const MeasuredMap& map, const Answer& answer, const Panel& panel) {
  const auto each = [&](auto&& draw_cell) {
    for (std::size_t row = 0; row < panel.rows; ++row)
      for (std::size_t column = 0; column < panel.columns; ++column)
        draw_cell(panel.cell(row, column), answer.difference[row][column]);
  };
  each([&](const Rectangle& cell, const Estimate& difference) {
    if (!difference.value) return;
    canvas.fill(cell, difference_colour(*difference.value));
    if (ahead(difference) == Ahead::undecided) canvas.hatch(cell, kFaint, kHatchSpacing, kHatchWidth);
    canvas.frame(cell, kPaper, 0.2);
  });
  draw_boundary(canvas, map, answer, panel);
  each([&](const Rectangle& cell, const Estimate& difference) {
    if (!difference.value) return draw_nothing(canvas, cell);
    const Colour ground = difference_colour(*difference.value), ink = ink_on(ground);
    canvas.rimmed_text(signed_percent(*difference.value), cell.middle_x(), cell.middle_y() - 1.6, kNumberSize,
                       ink, ground);
    canvas.rimmed_text(half_width(difference), cell.middle_x(), cell.middle_y() + 2.2, kSmallSize, ink,
                       ground);
  });
  draw_axes(canvas, map, panel);
  draw_title(
      canvas, panel,
      fmt::format("Locked share of tracking ({}) \u2212 of detection ({})", answer.tracker, answer.detector));
}

void draw_legend(Canvas& canvas, const MeasuredMap& map, double x, double y) {
  const Rectangle undecided{x, y - 2, 6, 4}, band{x + 53, y - 2, 6, 4};
  canvas.fill(undecided, difference_colour(0));
  canvas.hatch(undecided, kFaint, kHatchSpacing, kHatchWidth);
  canvas.frame(undecided, kInk, 0.15);
  canvas.text("undecided: the 95 % interval holds 0", undecided.right() + 1.5, y, kSmallSize, kInk,
              Anchor::left);
  canvas.fill(band, kFaint, 0.18);
  canvas.line(band.middle_x(), band.y, band.middle_x(), band.bottom(), kInk, 0.8);
  canvas.text("boundary, and its 95 % interval", band.right() + 1.5, y, kSmallSize, kInk, Anchor::left);
  canvas.text(fmt::format("{} flights of {:g} s a cell{}", map.plan.seeds, map.plan.flight.duration_s,
                          map.plan.across == Across::gap
                              ? fmt::format("; {:g} % of intervals are gaps", 100 * map.plan.gap_share)
                              : ""),
              band.right() + 42, y, kSmallSize, kInk, Anchor::left);
}

void draw_method(Canvas& canvas, const MeasuredMap& map, const MethodMap& method, const Panel& panel) {
  for (std::size_t row = 0; row < panel.rows; ++row) {
    for (std::size_t column = 0; column < panel.columns; ++column) {
      const Rectangle cell = panel.cell(row, column);
      const auto share = locked_share(method.cells[row][column]).value;
      if (!share) {
        draw_nothing(canvas, cell);
        continue;
      }
      const Colour ground = share_colour(*share);
      canvas.fill(cell, ground);
      canvas.frame(cell, kPaper, 0.2);
      canvas.text(percent(*share), cell.middle_x(), cell.middle_y(), kNumberSize, ink_on(ground),
                  Anchor::middle);
    }
  }
  draw_axes(canvas, map, panel);
  draw_title(canvas, panel, fmt::format("{} ({})", method.name, to_string(method.kind)));
}

/// Where everything stands.
struct Layout {
  Panel contest;
  std::vector<Panel> methods;
  double legend_y, height;
  double bar_x() const { return kPageWidth - kBarRoom + kGutter; }  // of colour bars
};

Layout layout_of(const MeasuredMap& map) {
  const std::size_t rows = map.blur.size(), columns = map.plan.columns.size();
  const double width = kPageWidth - kBarRoom;  // of all panels, their axes included
  Layout layout{{{kLeftOfPanel, kAbovePanel, width - kLeftOfPanel, kMainRow * static_cast<double>(rows)},
                 rows,
                 columns},
                {},
                0,
                0};
  layout.legend_y = layout.contest.area.bottom() + kBelowPanel;
  double y = layout.legend_y + kLegend;
  const double method_width = (width - kGutter) / 2 - kLeftOfPanel;
  const double method_height = kMethodRow * static_cast<double>(rows);
  for (std::size_t m = 0; m < map.methods.size(); ++m) {
    const double x = m % 2 == 0 ? kLeftOfPanel : 2 * kLeftOfPanel + kGutter + method_width;
    layout.methods.push_back({{x, y + kAbovePanel, method_width, method_height}, rows, columns});
    if (m % 2 == 1 || m + 1 == map.methods.size()) y += kAbovePanel + method_height + kBelowPanel;
  }
  layout.height = y + kMargin - 2;
  return layout;
}

void draw_map(Canvas& canvas, const MeasuredMap& map, const Answer& answer, const Layout& layout) {
  draw_contest(canvas, map, answer, layout.contest);
  const Rectangle& contest = layout.contest.area;
  draw_bar(canvas, {layout.bar_x(), contest.y, kBarWidth, contest.height}, -1, 1, difference_colour,
           signed_percent, "\u2190 detection   %   tracking \u2192");
  draw_legend(canvas, map, contest.x, layout.legend_y);
  for (std::size_t m = 0; m < map.methods.size(); ++m)
    draw_method(canvas, map, map.methods[m], layout.methods[m]);
  const Rectangle& first = layout.methods.front().area;
  draw_bar(canvas, {layout.bar_x(), first.y, kBarWidth, first.height}, 0, 1, share_colour, percent,
           "locked share, %");
}

}  // namespace

std::string svg_of(const MeasuredMap& map, const Answer& answer) {
  const Layout layout = layout_of(map);
  return svg_of_page(kPageWidth, layout.height,
                     [&](Canvas& canvas) { draw_map(canvas, map, answer, layout); });
}

std::string png_of(const MeasuredMap& map, const Answer& answer) {
  constexpr double kDotsPerInch = 200;
  const Layout layout = layout_of(map);
  return png_of_page(kPageWidth, layout.height, kDotsPerInch,
                     [&](Canvas& canvas) { draw_map(canvas, map, answer, layout); });
}

}  // namespace relock::maps
