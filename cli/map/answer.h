#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/map/boundary.h"
#include "cli/map/cells.h"
#include "cli/map/sweep.h"

namespace relock::maps {

/// Where the lead changes hands in one row.
struct RowAnswer {
  std::optional<Boundary> boundary;
  Ahead leads =
      Ahead::undecided;  ///< without a boundary: who is ahead in some cells while the other is in none
};

/// One tracker against one detector, over the whole map.
struct Answer {
  std::string tracker, detector;
  bool tracker_chosen = false, detector_chosen = false;  ///< named by the user; else the best over the map
  Grid<Estimate> difference;                             ///< of locked shares, tracker - detector
  std::vector<RowAnswer> rows;
};

/// Throws Error when the map has no such method, or none of the class.
Answer answer(const MeasuredMap& map, const std::optional<std::string>& tracker,
              const std::optional<std::string>& detector);

/// "gap, slots", "frame rate, Hz", "target size D, px".
std::string title_of_columns(Across across);
/// "mean blur, % of D"; of Across::size, where D differs from column to column, "mean blur, px".
std::string title_of_rows(Across across);
/// The row's blur in that unit; NaN where its flights never see the target.
double blur_of_row(const MeasuredMap& map, std::size_t row);
/// The same in a table: one decimal, or n/a.
std::string blur_cell(const MeasuredMap& map, std::size_t row);

/// What is printed: the map in letters, and a sentence for each row, from the most blur down.
std::string text_of(const MeasuredMap& map, const Answer& answer);
/// map.csv: a row for each cell and method, and for each cell the difference.
std::string csv_of(const MeasuredMap& map, const Answer& answer);
/// map.json: the same, the boundaries, and what it is made of.
std::string json_of(const MeasuredMap& map, const Answer& answer);

}  // namespace relock::maps
