#include "detectors/ring_marker.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

#include "core/error.h"

namespace relock {
namespace {

constexpr double kWidthTolerance = 0.1;  // of the mean width; the authors' own prints differ by 4 %

void check_bit_count(int bits) {
  if (bits < 1 || bits > kMostRingBits)
    throw Error(fmt::format("a ring marker has 1 to {} bits, not {}", kMostRingBits, bits));
}

std::string text_of(const Annulus& ring) { return fmt::format("{}-{}", ring.inner, ring.outer); }

[[noreturn]] void refuse_radii(std::string_view text, std::string_view all) {
  throw Error(
      fmt::format("the geometry \"{}\" is none (\"{}\"); write paper, even, or the radii of the rings as "
                  "parts of the largest: 0.18-0.33,0.41-0.55,0.855-1",
                  all, text));
}

double radius_of(std::string_view text, std::string_view all) {
  double value = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
    refuse_radii(text, all);
  return value;
}

std::vector<Annulus> slots_of(std::string_view text) {
  std::vector<Annulus> slots;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find_first_of(",/", at), text.size());
    const std::string_view ring = text.substr(at, end - at);
    const std::size_t dash = ring.find('-');
    if (dash == std::string_view::npos) refuse_radii(ring, text);
    slots.push_back({radius_of(ring.substr(0, dash), text), radius_of(ring.substr(dash + 1), text)});
    at = end + 1;
  }
  return slots;
}

bool has_ring(const RingMarker& marker, std::size_t slot) {
  const bool always = slot == 0 || slot + 1 == marker.geometry.slots.size();
  return always || marker.bits[marker.bits.size() - slot] == '1';
}

/// 0 at the quiet zone's edge, 1 at the sheet's.
double light_of_border(const RingGeometry& geometry, double rho) {
  if (rho >= geometry.quiet_zone + geometry.soft_border) return 1;
  return 0.5 - 0.5 * std::cos(std::numbers::pi * (rho - geometry.quiet_zone) / geometry.soft_border);
}

}  // namespace

RingGeometry paper_ring_geometry() {
  return {.slots = {{0.18, 0.33}, {0.41, 0.55}, {0.63, 0.77}, {0.855, 1.0}}};
}

RingGeometry even_ring_geometry(int bits) {
  check_bit_count(bits);
  RingGeometry geometry;
  const double units = 2 * bits + 4;
  for (int slot = 0; slot < bits + 2; ++slot)
    geometry.slots.push_back({(2 * slot + 1) / units, (2 * slot + 2) / units});
  return geometry;
}

RingGeometry ring_geometry(std::string_view text, int bits) {
  check_bit_count(bits);
  if (text == "paper" && bits == paper_ring_geometry().bits()) return paper_ring_geometry();
  if (text == "paper" || text == "even") return even_ring_geometry(bits);
  const RingGeometry geometry{.slots = slots_of(text)};
  if (geometry.bits() != bits)
    throw Error(fmt::format("the geometry \"{}\" has {} rings; {} bits need {}", text, geometry.slots.size(),
                            bits, bits + 2));
  check(geometry);
  return geometry;
}

std::string slots_text(const RingGeometry& geometry) {
  if (geometry.slots == paper_ring_geometry().slots) return "paper";
  const int bits = geometry.bits();
  if (bits >= 1 && bits <= kMostRingBits && geometry.slots == even_ring_geometry(bits).slots) return "even";
  std::vector<std::string> parts;
  for (const Annulus& slot : geometry.slots) parts.push_back(text_of(slot));
  return fmt::format("{}", fmt::join(parts, ","));
}

bool equally_wide(const RingGeometry& geometry) {
  double mean = 0;
  for (const Annulus& slot : geometry.slots)
    mean += slot.width() / static_cast<double>(geometry.slots.size());
  return std::all_of(geometry.slots.begin(), geometry.slots.end(), [&](const Annulus& slot) {
    return std::abs(slot.width() - mean) <= kWidthTolerance * mean;
  });
}

void check(const RingGeometry& geometry) {
  check_bit_count(geometry.bits());
  double last = -1e-9;  // the innermost ring may be a disc, from 0
  for (const Annulus& slot : geometry.slots) {
    if (!(slot.inner > last) || !(slot.outer > slot.inner))
      throw Error(
          fmt::format("the radii of the rings must rise from ring to ring, and {} does not", text_of(slot)));
    last = slot.outer;
  }
  if (last != 1) throw Error(fmt::format("the outermost ring must end at radius 1, not at {}", last));
  if (!(geometry.quiet_zone >= 1 && geometry.quiet_zone <= 4))
    throw Error(
        fmt::format("the quiet zone must reach to 1 to 4 times the radius, not to {}", geometry.quiet_zone));
  if (!(geometry.soft_border >= 0 && geometry.soft_border <= 2))
    throw Error(fmt::format("the soft border must be 0 to 2 radii wide, not {}", geometry.soft_border));
}

void check_ring_bits(std::string_view bits) {
  if (bits.empty() || bits.size() > kMostRingBits || bits.find_first_not_of("01") != std::string_view::npos)
    throw Error(
        fmt::format("\"{}\" are no bits of a ring marker; write 1 to {} of the characters 0 and 1, as in "
                    "ring:01",
                    bits, kMostRingBits));
}

std::vector<std::string> all_ring_bits(int bits) {
  check_bit_count(bits);
  std::vector<std::string> all;
  for (unsigned number = 0; number < 1U << bits; ++number)
    all.push_back(fmt::format("{:0{}b}", number, bits));
  return all;
}

std::string ring_family(int bits) { return fmt::format("ring{}", bits); }

std::string_view to_string(SheetColour colour) {
  constexpr std::array<std::string_view, kSheetColours> names{"black", "red", "green", "blue"};
  return names.at(static_cast<std::size_t>(colour));
}

Reflected reflected_by(SheetColour colour) {
  switch (colour) {
    case SheetColour::black:
      return {};
    case SheetColour::red:
      return {.red = 0.5};
    case SheetColour::green:
      return {.green = 0.2};  // the eye and the camera see green the most
    case SheetColour::blue:
      break;
  }
  return {.blue = 0.6};
}

SheetColour nearest_sheet_colour(const Reflected& seen) {
  const auto distance = [&](SheetColour colour) {
    const Reflected is = reflected_by(colour);
    return std::hypot(seen.red - is.red, seen.green - is.green, seen.blue - is.blue);
  };
  SheetColour nearest = SheetColour::black;
  for (const SheetColour colour : {SheetColour::red, SheetColour::green, SheetColour::blue})
    if (distance(colour) < distance(nearest)) nearest = colour;
  return nearest;
}

RingValue parse_ring_value(std::string_view value) {
  const std::size_t dash = value.find('-');
  RingValue parsed{std::string(value.substr(0, dash))};
  check_ring_bits(parsed.bits);
  if (dash == std::string_view::npos) return parsed;
  for (const SheetColour colour : {SheetColour::red, SheetColour::green, SheetColour::blue})
    if (value.substr(dash + 1) == to_string(colour)) {
      parsed.sheet = colour;
      return parsed;
    }
  throw Error(fmt::format("no sheet of a ring marker is called \"{}\"; there are red, green and blue",
                          value.substr(dash + 1)));
}

std::string to_string(const RingValue& value) {
  return value.sheet == SheetColour::black ? value.bits
                                           : fmt::format("{}-{}", value.bits, to_string(value.sheet));
}

Code code_of(const RingMarker& marker) {
  return {ring_family(marker.geometry.bits()), to_string(RingValue{marker.bits, marker.sheet})};
}

std::vector<Annulus> rings_of(const RingMarker& marker) {
  std::vector<Annulus> rings;
  for (std::size_t slot = 0; slot < marker.geometry.slots.size(); ++slot)
    if (has_ring(marker, slot)) rings.push_back(marker.geometry.slots[slot]);
  return rings;
}

double reflectance(const RingMarker& marker, double rho) {
  const RingGeometry& geometry = marker.geometry;
  if (rho > geometry.quiet_zone) return geometry.inverted ? 1 : light_of_border(geometry, rho);
  const auto rings = rings_of(marker);
  const bool white = std::any_of(rings.begin(), rings.end(),
                                 [&](const Annulus& ring) { return rho >= ring.inner && rho < ring.outer; });
  return white != geometry.inverted ? 1 : 0;
}

}  // namespace relock
