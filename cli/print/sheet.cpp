#include "cli/print/sheet.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

#include "core/error.h"
#include "core/nearest.h"

namespace relock {
namespace {

struct Paper {
  const char* name;
  double width_mm;
  double height_mm;
};
constexpr Paper kPapers[] = {{"a4", 210, 297}, {"a3", 297, 420}, {"letter", 215.9, 279.4}};
constexpr double kMarginMm = 4;
constexpr double kApartMm = 6;
constexpr double kSlackMm = 1e-6;  // of sums

std::optional<Paper> paper_called(const std::string& name) {
  std::vector<std::string> names{"marker"};
  for (const Paper& paper : kPapers) {
    if (name == paper.name) return paper;
    names.emplace_back(paper.name);
  }
  if (name == names[0]) return {};
  throw Error(fmt::format("--paper is \"{}\"{}; it must be one of {}", name, did_you_mean(name, names),
                          fmt::join(names, ", ")));
}

PlacedMarker unplaced(const Design& design, const SheetOptions& options) {
  return {.design = design,
          .size_mm = 1000 * options.size_m,
          .corner_mm = {},
          .caption = options.captions ? caption_of(design, options.size_m) : std::vector<std::string>{}};
}

double height_mm(const PlacedMarker& marker) {
  return marker.sheet_mm() + kCaptionLineMm * static_cast<double>(marker.caption.size());
}

void check_fit(const PlacedMarker& marker, const Paper& paper) {
  const double width = paper.width_mm - 2 * kMarginMm, height = paper.height_mm - 2 * kMarginMm;
  if (marker.sheet_mm() <= width + kSlackMm && height_mm(marker) <= height + kSlackMm) return;
  throw Error(fmt::format(
      "{} of {:.5g} mm needs {:.5g} x {:.5g} mm with its margins, and {} has {:.5g} x {:.5g} mm to print on; "
      "take "
      "a smaller --size or a larger --paper",
      marker.design.name, marker.size_mm, marker.sheet_mm(), height_mm(marker), paper.name, width, height));
}

/// Rows fill from the left and are centred when they are full.
class Rows {
 public:
  explicit Rows(const Paper& paper) : paper_(paper) {}

  void add(PlacedMarker marker) {
    const double left = row_.empty() ? kMarginMm : right_mm_ + kApartMm;
    if (!row_.empty() && left + marker.sheet_mm() > paper_.width_mm - kMarginMm + kSlackMm) {
      end_row();
      add(std::move(marker));
      return;
    }
    marker.corner_mm.x = left;
    right_mm_ = left + marker.sheet_mm();
    row_height_mm_ = std::max(row_height_mm_, height_mm(marker));
    row_.push_back(std::move(marker));
  }

  std::vector<Page> pages() {
    end_row();
    return std::move(pages_);
  }

 private:
  void end_row() {
    if (row_.empty()) return;
    if (pages_.empty() || top_mm_ + row_height_mm_ > paper_.height_mm - kMarginMm + kSlackMm) {
      pages_.push_back({.width_mm = paper_.width_mm, .height_mm = paper_.height_mm, .markers = {}});
      top_mm_ = kMarginMm;
    }
    const double centring = (paper_.width_mm - kMarginMm - right_mm_) / 2;
    for (PlacedMarker& marker : row_) {
      marker.corner_mm = {marker.corner_mm.x + centring, top_mm_};
      pages_.back().markers.push_back(std::move(marker));
    }
    top_mm_ += row_height_mm_ + kApartMm;
    row_.clear();
    row_height_mm_ = 0;
  }

  Paper paper_;
  std::vector<Page> pages_;
  std::vector<PlacedMarker> row_;
  double right_mm_ = 0, row_height_mm_ = 0, top_mm_ = 0;
};

}  // namespace

std::vector<Page> lay_out(const std::vector<Design>& designs, const SheetOptions& options) {
  const std::optional<Paper> paper = paper_called(options.paper);
  if (paper) {
    Rows rows(*paper);
    for (const Design& design : designs) {
      const PlacedMarker marker = unplaced(design, options);
      check_fit(marker, *paper);
      rows.add(marker);
    }
    return rows.pages();
  }
  std::vector<Page> pages;
  for (const Design& design : designs) {
    const PlacedMarker marker = unplaced(design, options);
    pages.push_back({.width_mm = marker.sheet_mm(), .height_mm = height_mm(marker), .markers = {marker}});
  }
  return pages;
}

}  // namespace relock
