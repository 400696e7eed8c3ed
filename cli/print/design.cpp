#include "cli/print/design.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "core/error.h"
#include "core/nearest.h"
#include "core/options.h"
#include "detectors/printed_square.h"

namespace relock {
namespace {

/// A name taken apart: FAMILY(OPTION=VALUE,…):VALUE.
struct NameParts {
  std::string family;
  std::map<std::string, std::string> options;
  std::optional<std::string> value;
};

NameParts parts_of(std::string_view name) {
  const std::size_t open = name.find('('), close = name.rfind(')');
  if ((open == std::string_view::npos) != (close == std::string_view::npos) || (open > close))
    throw Error(fmt::format("{}: a parenthesis is missing", name));
  const std::size_t colon = name.find(':', close == std::string_view::npos ? 0 : close);
  NameParts parts;
  if (colon != std::string_view::npos) parts.value = name.substr(colon + 1);
  parts.family = name.substr(0, std::min(open, colon));
  if (open == std::string_view::npos) return parts;
  if (std::min(colon, name.size()) != close + 1)
    throw Error(fmt::format("{}: a colon and a value belong behind the parenthesis", name));
  for (const std::string& option : names_in(name.substr(open + 1, close - open - 1))) {
    const std::size_t equals = option.find('=');
    if (equals == std::string::npos)
      throw Error(fmt::format("{}: an option is written name=value, \"{}\" is not", name, option));
    if (!parts.options.emplace(option.substr(0, equals), option.substr(equals + 1)).second)
      throw Error(fmt::format("{}: option {} is given twice", name, option.substr(0, equals)));
  }
  return parts;
}

RingGeometry geometry_of(const NameParts& parts, int bits, const RingLook& look) {
  const Options options("ring",
                        {{"geometry", look.geometry, "", ""},
                         {"quiet_zone", fmt::format("{}", look.quiet_zone), "R", ""},
                         {"soft_border", fmt::format("{}", look.soft_border), "R", ""},
                         {"inverted", look.inverted ? "true" : "false", "", ""}},
                        parts.options);
  RingGeometry geometry = ring_geometry(options.word("geometry"), bits);
  geometry.quiet_zone = options.number("quiet_zone", 1, 4);
  geometry.soft_border = options.number("soft_border", 0, 2);
  geometry.inverted = options.flag("inverted");
  return geometry;
}

Design ring_design(std::string_view name, const NameParts& parts, const RingLook& look) {
  const auto [bits, sheet] = parse_ring_value(parts.value.value_or(""));
  const int count = static_cast<int>(bits.size());
  if (parts.family != "ring" && parts.family != ring_family(count))
    throw Error(
        fmt::format("{} has {} bits; write ring:{} or {}:{}", name, count, bits, ring_family(count), bits));
  const RingMarker marker{.geometry = geometry_of(parts, count, look), .bits = bits, .sheet = sheet};
  if (marker.geometry.inverted && sheet != SheetColour::black)
    throw Error(fmt::format("{}: an inverted marker has a white sheet, and no colour", name));
  return {.name = std::string(name), .code = code_of(marker), .form = marker};
}

/// A ring marker of nothing but one ring without a hole.
Design disc_design(std::string_view name) {
  return {
      .name = std::string(name), .code = {}, .form = RingMarker{.geometry = {.slots = {{0, 1}}}, .bits = ""}};
}

/// A family and what may stand for one: "ring", "ring2" and the like.
bool is_ring_family(std::string_view family) {
  return family.starts_with("ring") &&
         family.substr(4).find_first_not_of("0123456789") == std::string_view::npos;
}

[[noreturn]] void refuse_family(const std::string& family) {
  std::vector<std::string> known = square_marker_families();
  known.insert(known.begin(), {"ring", "disc"});
  const std::string meant = did_you_mean(family, known);
  throw Error(fmt::format("no markers are called \"{}\"{}", family,
                          meant.empty() ? fmt::format("; there are {}", fmt::join(known, ", ")) : meant));
}

std::string ring_caption(const RingMarker& marker) {
  const RingGeometry& geometry = marker.geometry;
  std::vector<std::string> slots;
  for (std::size_t slot = 0; slot < geometry.slots.size(); ++slot) {
    const bool bit = slot != 0 && slot + 1 != geometry.slots.size();
    const Annulus& s = geometry.slots[slot];
    slots.push_back(fmt::format("{}{:.4g}-{:.4g}{}", bit ? "(" : "", s.inner, s.outer, bit ? ")" : ""));
  }
  const std::string sheet = geometry.inverted
                                ? fmt::format("white to {:.4g}", geometry.quiet_zone)
                                : fmt::format("{} to {:.4g}, white from {:.4g}", to_string(marker.sheet),
                                              geometry.quiet_zone, geometry.sheet_radius());
  return fmt::format("rings (bits) r/R {}; {}", fmt::join(slots, " "), sheet);
}

std::string cells_caption(const MarkerCells& cells, double size_m) {
  const int across = cells.side - 2 * cells.margin;
  return fmt::format("the side is {} cells of {:.4g} mm", across, 1000 * size_m / across);
}

}  // namespace

double Design::sheet() const {
  if (const auto* ring = std::get_if<RingMarker>(&form)) return ring->geometry.sheet_radius();
  const auto& cells = std::get<MarkerCells>(form);
  return static_cast<double>(cells.side) / (cells.side - 2 * cells.margin);
}

Design design_of(std::string_view name, const RingLook& look) {
  const NameParts parts = parts_of(name);
  if (is_ring_family(parts.family)) return ring_design(name, parts, look);
  const auto squares = square_marker_families();
  const bool square = std::find(squares.begin(), squares.end(), parts.family) != squares.end();
  if (!square && parts.family != "disc") refuse_family(parts.family);
  if (!parts.options.empty()) throw Error(fmt::format("{}: only ring markers have options", name));
  if (!square) {
    if (parts.value) throw Error(fmt::format("{}: a disc has no value; write disc", name));
    return disc_design(name);
  }
  const Code code{parts.family, parts.value.value_or("")};
  return {.name = std::string(name), .code = code, .form = square_marker_cells(code)};
}

std::vector<std::string> names_in(std::string_view list) {
  std::vector<std::string> names(1);
  int depth = 0;
  for (const char c : list) {
    depth += c == '(' ? 1 : c == ')' ? -1 : 0;
    if (c == ',' && depth == 0) {
      names.emplace_back();
    } else {
      names.back() += c;
    }
  }
  return names;
}

std::vector<std::string> caption_of(const Design& design, double size_m) {
  const std::string label =
      design.code
          ? design.code->family.starts_with("ring") ? "ring:" + design.code->value : to_string(*design.code)
          : design.name;
  const std::string size = fmt::format("{:.5g} mm", 1000 * size_m);
  if (const auto* cells = std::get_if<MarkerCells>(&design.form))
    return {fmt::format("{}   side {}", label, size), cells_caption(*cells, size_m)};
  const auto& ring = std::get<RingMarker>(design.form);
  if (!design.code) return {fmt::format("{}   diameter {}", label, size)};
  const std::string slots = slots_text(ring.geometry);
  return {fmt::format("{}   diameter {}   {} geometry{}", label, size,
                      slots == "paper" || slots == "even" ? slots : "own",
                      ring.geometry.inverted ? "   inverted" : ""),
          ring_caption(ring)};
}

}  // namespace relock
