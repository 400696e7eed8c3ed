#pragma once

#include <cmath>
#include <optional>
#include <string_view>

#include "core/sighting.h"

namespace relock {

/// What is known of a target beforehand and for ever: prior knowledge, no truth of any frame.
struct Target {
  TargetId id;
  std::optional<Code> code = {};      ///< what a reader of codes should read on it
  std::optional<double> size_m = {};  ///< side or diameter, metres
  friend bool operator==(const Target&, const Target&) = default;
};

/// What the labels say of a target on a recorded frame (metrics.md section 1).
enum class Label : std::uint8_t { unlabelled, visible, absent };
std::string_view to_string(Label label);

/// Image motion of a target over the exposure, from its start to its end, px.
using BlurVector = Vec2;

/// Truth of one target on one recorded frame. For a moving target it is the mean over the exposure.
///
/// An unlabelled target may still have a known place (half out of the picture, say); `outline` then is where.
struct TargetTruth {
  Label label = Label::unlabelled;
  std::optional<Outline> outline = {};        ///< unoccluded and unblurred; always there when visible
  std::optional<Vec2> centre_projected = {};  ///< image of the physical centre, px
  double visible_fraction = 1.0;              ///< part of the outline in the picture and unoccluded
  double occluded_fraction = 0.0;             ///< part of the outline hidden by something in the scene
  std::optional<BlurVector> blur = {};        ///< px
  std::optional<double> tilt_deg = {};        ///< between the target's normal and the line of sight
  double sigma_px = 0.0;                      ///< accuracy of the label, one standard deviation; 0: exact

  /// Size D, px (core/geometry.h, size_of). Needs the outline.
  double size_px() const { return size_of(*outline); }
  /// The centre that a sighting of `kind` is compared with; the outline's where the projected is not known.
  Vec2 centre(CentreKind kind) const {
    return kind == CentreKind::projected && centre_projected ? *centre_projected : centre_of(*outline);
  }
};

}  // namespace relock
