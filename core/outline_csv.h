#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/csv.h"
#include "core/geometry.h"

// Outlines in CSV files, labels and trajectories alike. A file may have any of three sets of columns, and
// each row fills at most one of them:
//   x, y, width, height                                            a box: left and top edge, px
//   x1, y1, x2, y2, x3, y3, x4, y4                                 a quad: top left, top right, bottom right,
//   … ellipse_x, ellipse_y, semi_major, semi_minor, angle_rad        an ellipse

namespace relock {

/// Smaller outlines are none: files have four decimals.
constexpr double kSmallestOutline_px = 1e-3;

/// Names of all outline columns, in the order in which they are written.
const std::vector<std::string>& outline_columns();
/// A file's other columns, and behind them the outline columns.
std::vector<std::string> with_outline_columns(std::vector<std::string> others);

/// Finds a file's outline columns once and reads an outline from each row.
class OutlineColumns {
 public:
  /// Throws Error when a set of columns is there only in part.
  explicit OutlineColumns(const CsvReader& rows);
  bool any() const;
  /// Nothing if all cells are empty. Throws Error on a set filled in part, on two sets, on no size.
  std::optional<Outline> read(const CsvReader& rows) const;

 private:
  std::vector<CsvReader::Column> box_, quad_, ellipse_;
};

/// Appends the cells of all outline columns, each behind a comma, to `line`; `decimals` after the point.
void append_outline(std::string& line, const std::optional<Outline>& outline, int decimals);

}  // namespace relock
