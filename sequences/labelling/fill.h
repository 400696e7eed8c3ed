#pragma once

#include <span>
#include <vector>

#include "sequences/labelling/key_frames.h"
#include "sequences/labels.h"

namespace relock {

struct FillOptions {
  double max_gap_s = 2.0;  ///< between placed key frames: the curve does not go over more
  LabelLimits limits = {};
  /// How much a target's velocity usually changes, in its sizes: variance per second. What the key frames themselves
  /// tell soon outweighs it.
  double usual_restlessness = 100;
};

/// What a frame's label rests on.
enum class RestsOn : std::uint8_t {
  key,      ///< somebody said it of this very frame
  curve,    ///< a smooth curve through the placed key frames before and after
  held,     ///< the last key frame's state lasts: absent, unlabelled, or hidden without a place
  unknown,  ///< no key frame tells
};

/// The labels of one target on every frame.
struct FilledTarget {
  std::vector<TargetTruth> truth;  ///< source hand, spline or detector; sigma_px of each
  std::vector<RestsOn> rests_on;
  /// By how much the stated sigma of the curve was raised so that left-out key frames fall within it as often as it
  /// says: 1 where it was honest by itself.
  double widened = 1;
};

/// From key frames to every frame.
///
/// A placed key frame is the label of its own frame. From one to the next goes a smooth curve on true time (SmoothCurve)
/// of position, and of the logarithms of size; not across a key frame that says absent or unlabelled, nor over more than
/// `max_gap_s`, nor from one kind of outline to another. On both sides of what it does not cross, frames that nobody
/// spoke of are unlabelled: when a target went is known only where somebody said so. The restlessness of the curve is
/// what foretells left-out key frames best, and sigma_px is the curve's own standard deviation.
/// `captured`: of all frames.
FilledTarget fill(const KeyedTarget& target, std::span<const Time> captured, Size picture,
                  const FillOptions& options);

/// A placed key frame against the curve through the others.
struct KeyResidual {
  std::size_t frame = 0;
  Vec2 error_px;        ///< placed - curve, of the centre
  double sigma_px = 0;  ///< that the curve states for it along each axis, that of the placing included
  double size_px = 0;   ///< D there
};
/// Fills once more for each placed key frame without it. Those that the others do not reach are left out.
std::vector<KeyResidual> cross_validate(const KeyedTarget& target, std::span<const Time> captured,
                                        Size picture, const FillOptions& options);

}  // namespace relock
