#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/sighting.h"
#include "detectors/marker_cells.h"
#include "detectors/ring_marker.h"

namespace relock {

/// What the rings of a call look like unless a marker's own name says otherwise.
struct RingLook {
  std::string geometry = "paper";  ///< as ring_geometry() takes it
  double quiet_zone = RingGeometry{}.quiet_zone;
  double soft_border = RingGeometry{}.soft_border;
  bool inverted = false;
  friend bool operator==(const RingLook&, const RingLook&) = default;
};

/// A marker that can be printed, of no size yet.
///
/// Lengths are parts of its size: the diameter of a ring marker or a disc, the side of the square that a
/// detector of square markers reports.
struct Design {
  std::string name;          ///< as it was asked for
  std::optional<Code> code;  ///< what a reader should read; none on a disc
  std::variant<RingMarker, MarkerCells> form;

  bool round() const { return std::holds_alternative<RingMarker>(form); }
  /// Side of the square that holds all of it, white margins and soft border too.
  double sheet() const;
};

/// The design that a name stands for:
/// - "ring:01" or "ring2:01"; "ring:01-red", on a red, green or blue sheet; "ring(geometry=even,quiet_zone=1.5,soft_border=0.2,inverted=true):01";
/// - "aruco6x6_250:23", "apriltag36h11:5": codes as the detectors name them;
/// - "disc": a white disc on a black sheet like the rings'.
/// Throws Error for a name that is none.
Design design_of(std::string_view name, const RingLook& look = {});

/// "ring:01,aruco6x6_250:0" as its names; commas in parentheses do not count.
std::vector<std::string> names_in(std::string_view list);

/// What is printed below a marker of that size: its code, its size and how it is made up; two lines.
std::vector<std::string> caption_of(const Design& design, double size_m);

}  // namespace relock
