#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/print/design.h"
#include "core/geometry.h"

namespace relock {

/// A design in its place on a page.
struct PlacedMarker {
  Design design;
  double size_mm = 0;                ///< diameter or side, as Design says
  Vec2 corner_mm;                    ///< top left corner of its sheet, from the page's, x right, y down
  std::vector<std::string> caption;  ///< lines below its sheet

  double sheet_mm() const { return size_mm * design.sheet(); }
};

struct Page {
  double width_mm = 0;
  double height_mm = 0;
  std::vector<PlacedMarker> markers;
};

struct SheetOptions {
  double size_m = 0.15;  ///< of every marker
  std::string paper =
      "marker";  ///< a4, a3, letter (all upright), or marker: each on a page just as large as it
  bool captions = true;
};

/// Height of a caption's line and of its letters.
constexpr double kCaptionLineMm = 3.6, kCaptionTextMm = 2.8;

/// Lays the markers out in their order, in rows from the top of as many pages as they need, 4 mm from the
/// paper's edge, where printers do not print. Throws Error for paper that is none, and when a marker does not
/// fit on it.
std::vector<Page> lay_out(const std::vector<Design>& designs, const SheetOptions& options);

}  // namespace relock
