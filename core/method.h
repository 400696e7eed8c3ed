#pragma once

#include "core/frame.h"
#include "core/sighting.h"
#include "core/truth.h"

namespace relock {

/// What replay drives: something that is shown the delivered frames in order and says what it sees.
///
/// It is never shown truth, the future or another method; what it may know beforehand passes through `Target`
/// and through `start`. core/compose.h builds Methods from detectors and trackers.
class Method {
 public:
  virtual ~Method() = default;

  /// Whether `start` does anything: a method that cannot be handed a box is judged from the frame after the
  /// one on which the others are started.
  virtual bool takes_boxes() const = 0;

  /// Hands over the true box of `target` in `frame`; called again to restart after a loss. It does not take
  /// the place of `locate`, which is called for every delivered frame and answers for the other targets.
  virtual void start(const Frame& frame, const Target& target, const Box& box) = 0;

  /// Everything seen in `frame`. Targets started on this very frame are left out of the answer.
  virtual Sightings locate(const Frame& frame) = 0;
};

}  // namespace relock
