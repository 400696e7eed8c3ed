#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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

/// Where a label comes from. Whoever made a label must not be judged by it.
struct LabelSource {
  enum class Kind : std::uint8_t {
    unstated,  ///< nobody said
    hand,      ///< a person placed it
    spline,    ///< a curve through labels of frames before and after
    detector,  ///< a method's answer, taken over
  };
  Kind kind = Kind::unstated;
  /// Names of the methods whose answer it is, or through whose answers the curve goes; sorted.
  std::vector<std::string> detectors = {};
  friend bool operator==(const LabelSource&, const LabelSource&) = default;
};
/// "hand", "spline", "detector ring", "spline detector aruco+ring"; empty where nobody said.
std::string to_string(const LabelSource& source);
/// Throws Error when `text` is none.
LabelSource parse_label_source(std::string_view text);
/// Whether a method, as it would be typed, made the label or has a part that did: "hybrid(ring,kcf)" what `ring` did.
bool stems_from(const LabelSource& source, std::string_view method);

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
  LabelSource source = {};

  /// Size D, px (core/geometry.h, size_of). Needs the outline.
  double size_px() const { return size_of(*outline); }
  /// The centre that a sighting of `kind` is compared with; the outline's where the projected is not known.
  Vec2 centre(CentreKind kind) const {
    return kind == CentreKind::projected && centre_projected ? *centre_projected : centre_of(*outline);
  }
};

}  // namespace relock
