#include "core/outline_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

namespace relock {
namespace {

constexpr std::size_t kBox = 4, kQuad = 8, kEllipse = 5;

std::span<const std::string> names(std::size_t from, std::size_t count) {
  return std::span(outline_columns()).subspan(from, count);
}

std::vector<CsvReader::Column> columns(const CsvReader& rows, std::span<const std::string> names) {
  std::vector<CsvReader::Column> found;
  for (const std::string& name : names) found.push_back(rows.optional_column(name));
  const auto missing = std::count(found.begin(), found.end(), CsvReader::missing);
  if (missing == static_cast<std::ptrdiff_t>(found.size())) return {};
  for (std::size_t i = 0; i < found.size(); ++i)
    if (found[i] == CsvReader::missing) rows.column(names[i]);  // says which one is missing
  return found;
}

/// The numbers of one set of columns; nothing if all are empty.
std::optional<std::vector<double>> numbers(const CsvReader& rows,
                                           const std::vector<CsvReader::Column>& columns) {
  if (std::all_of(columns.begin(), columns.end(), [&](auto c) { return rows.text(c).empty(); })) return {};
  std::vector<double> values;
  for (const auto column : columns) values.push_back(rows.number(column));
  return values;
}

}  // namespace

const std::vector<std::string>& outline_columns() {
  static const std::vector<std::string> all{
      "x",         "y",         "width",      "height",                                    // box
      "x1",        "y1",        "x2",         "y2",         "x3",       "y3", "x4", "y4",  // quad
      "ellipse_x", "ellipse_y", "semi_major", "semi_minor", "angle_rad"};
  return all;
}

std::vector<std::string> with_outline_columns(std::vector<std::string> others) {
  others.insert(others.end(), outline_columns().begin(), outline_columns().end());
  return others;
}

OutlineColumns::OutlineColumns(const CsvReader& rows)
    : box_(columns(rows, names(0, kBox))),
      quad_(columns(rows, names(kBox, kQuad))),
      ellipse_(columns(rows, names(kBox + kQuad, kEllipse))) {}

bool OutlineColumns::any() const { return !box_.empty() || !quad_.empty() || !ellipse_.empty(); }

std::optional<Outline> OutlineColumns::read(const CsvReader& rows) const {
  std::optional<Outline> outline;
  const auto set = [&](const Outline& found) {
    if (outline) rows.fail("this row has two outlines; fill the cells of one");
    outline = found;
  };
  if (const auto v = numbers(rows, box_)) set(Box{(*v)[0], (*v)[1], (*v)[2], (*v)[3]});
  if (const auto v = numbers(rows, quad_)) {
    Quad quad;
    for (std::size_t i = 0; i < 4; ++i) quad.corner[i] = {(*v)[2 * i], (*v)[2 * i + 1]};
    set(quad);
  }
  if (const auto v = numbers(rows, ellipse_)) set(Ellipse{{(*v)[0], (*v)[1]}, (*v)[2], (*v)[3], (*v)[4]});
  if (outline && (!well_formed(*outline) || size_of(*outline) < kSmallestOutline_px))
    rows.fail("the outline has no size, or its axes are in the wrong order");
  return outline;
}

void append_outline(std::string& line, const std::optional<Outline>& outline, int decimals) {
  std::array<std::optional<double>, kBox + kQuad + kEllipse> cells;
  if (outline) {
    if (const auto* b = std::get_if<Box>(&*outline)) {
      cells[0] = b->x, cells[1] = b->y, cells[2] = b->width, cells[3] = b->height;
    } else if (const auto* q = std::get_if<Quad>(&*outline)) {
      for (std::size_t i = 0; i < 4; ++i)
        cells[kBox + 2 * i] = q->corner[i].x, cells[kBox + 2 * i + 1] = q->corner[i].y;
    } else if (const auto* e = std::get_if<Ellipse>(&*outline)) {
      const std::array<double, kEllipse> values{e->centre.x, e->centre.y, e->semi_major, e->semi_minor,
                                                e->angle_rad};
      std::copy(values.begin(), values.end(), cells.begin() + kBox + kQuad);
    }
  }
  for (const auto& cell : cells) {
    line += ',';
    if (cell) fmt::format_to(std::back_inserter(line), "{:.{}f}", *cell, decimals);
  }
}

}  // namespace relock
