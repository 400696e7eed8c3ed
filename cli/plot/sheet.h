#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

// The sheet that a plot is drawn on, and the file that it becomes.

namespace relock::figure {

/// Names with samples of what they name: beside the panel on the right, or below it in rows, where names are so
/// long or so many that they would take the panel's place.
struct Legend {
  std::string script;
  std::size_t rows_below = 0;
};
Legend legend_for(const std::vector<std::string>& names, double width_mm, double height_mm);
Legend legend_below(const std::vector<std::string>& names, double width_mm);

/// Height that a panel must have for it.
double least_panel_mm(const Legend& legend);

/// What a plot is drawn on: thin axes on the left and below, a light grid, the title above.
struct Sheet {
  std::string title;
  double width_mm, height_mm;
  std::size_t rows_below = 0;  ///< of the legend
};
std::string sheet(const Sheet& sheet);
/// What of its height is not the panel's.
double margins_mm(const Sheet& sheet);
/// Of that, above the panel.
double above_mm(const Sheet& sheet);

/// Has gnuplot draw the script into the file. Throws Error as draw() does.
void draw_into(const std::filesystem::path& file, double width_mm, double height_mm,
               const std::string& script);

}  // namespace relock::figure
