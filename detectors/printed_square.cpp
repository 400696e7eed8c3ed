#include "detectors/printed_square.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "core/error.h"
#include "core/nearest.h"
#include "detectors/apriltag.h"
#include "detectors/aruco.h"

namespace relock {
namespace {

int number_of(const Code& code) {
  int number = 0;
  const char* const end = code.value.data() + code.value.size();
  const auto [stop, fault] = std::from_chars(code.value.data(), end, number);
  if (fault != std::errc{} || stop != end || number < 0)
    throw Error(fmt::format("\"{}\" is no number of a marker; write {}:0", code.value, code.family));
  return number;
}

bool black_at_the_edge(const MarkerCells& cells) {
  for (int i = 0; i < cells.side; ++i)
    for (const int at : {i, (cells.side - 1) * cells.side + i, i * cells.side, (i + 1) * cells.side - 1})
      if (cells.grey[static_cast<std::size_t>(at)] < 255) return true;
  return false;
}

/// Families with bits outside of their border fill their print to its edge.
MarkerCells with_white_around(const MarkerCells& cells) {
  MarkerCells wider{.side = cells.side + 2, .margin = cells.margin + 1, .grey = {}};
  wider.grey.assign(static_cast<std::size_t>(wider.side) * static_cast<std::size_t>(wider.side), 255);
  for (int y = 0; y < cells.side; ++y)
    std::copy_n(cells.grey.begin() + y * cells.side, cells.side,
                wider.grey.begin() + (y + 1) * wider.side + 1);
  return wider;
}

}  // namespace

std::vector<std::string> square_marker_families() {
  std::vector<std::string> families;
  for (const std::string& dictionary : aruco_dictionaries())
    families.push_back(aruco_family({.dictionary = dictionary}));
  for (const std::string& family : apriltag_families())
    families.push_back(apriltag_family({.family = family}));
  return families;
}

MarkerCells square_marker_cells(const Code& code) {
  const auto families = square_marker_families();
  if (std::find(families.begin(), families.end(), code.family) == families.end())
    throw Error(fmt::format("no square markers are called \"{}\"{}", code.family,
                            did_you_mean(code.family, families)));
  const std::string aruco = "aruco", april = "april";
  const MarkerCells cells = code.family.starts_with(aruco)
                                ? aruco_cells(code.family.substr(aruco.size()), number_of(code))
                                : apriltag_cells(code.family.substr(april.size()), number_of(code));
  return black_at_the_edge(cells) ? with_white_around(cells) : cells;
}

}  // namespace relock
