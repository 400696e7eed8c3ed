#pragma once

#include <compare>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry.h"

namespace relock {

/// What a marker says: a family and a value in it, written "aruco6x6_250:23" or "ring2:01".
struct Code {
  std::string family;
  std::string value;

  friend auto operator<=>(const Code&, const Code&) = default;
};
std::string to_string(const Code& code);
/// Throws Error when `text` is not FAMILY:VALUE.
Code parse_code(std::string_view text);

/// Name of a target within its recording.
using TargetId = std::string;

/// Two centres of a target are different things under perspective; both are kept where known.
enum class CentreKind : std::uint8_t {
  projected,  ///< the image of the target's physical centre
  outline,    ///< the centre of its outline in the picture
};
std::string_view to_string(CentreKind kind);
CentreKind parse_centre_kind(std::string_view text);

/// Image motion over the exposure as a picture shows it: a direction without a sign.
struct BlurEstimate {
  double direction_rad = 0;  ///< from +x towards +y, in [0, pi)
  double length_px = 0;
  friend bool operator==(const BlurEstimate&, const BlurEstimate&) = default;
};

/// How uncertain a point or a vector is: its covariance, px^2.
struct Covariance {
  double xx = 0, xy = 0, yy = 0;
  friend bool operator==(const Covariance&, const Covariance&) = default;
};

/// Where a method says a target is, in one picture.
///
/// Coordinates are pixels, pixel centres at integers, x right, y down (core/geometry.h).
struct Sighting {
  Vec2 centre;  ///< px; which centre it is, `centre_kind` says
  CentreKind centre_kind = CentreKind::outline;
  Outline outline;                        ///< around the whole target
  std::optional<Code> code = {};          ///< what was read; empty for methods that read no codes
  std::optional<TargetId> track = {};     ///< the target being followed; empty for detections
  double confidence = 1.0;                ///< in [0, 1], comparable only within one method
  std::optional<BlurEstimate> blur = {};  ///< empty: not estimated
  /// Of the centre, and of the blur as a vector; empty: not estimated. No file of results keeps them.
  std::optional<Covariance> centre_covariance = {}, blur_covariance = {};
  friend bool operator==(const Sighting&, const Sighting&) = default;
};

/// Everything a method says of one frame; empty: "nothing there".
using Sightings = std::vector<Sighting>;

/// A sighting of `outline` about its own centre.
inline Sighting sighting_of(const Outline& outline) {
  return {.centre = centre_of(outline), .centre_kind = CentreKind::outline, .outline = outline};
}

}  // namespace relock
