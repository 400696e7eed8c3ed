#pragma once

#include <optional>

#include "core/frame.h"
#include "core/sighting.h"

namespace relock {

/// Follows one target from a given box. This is one of the two interfaces a plug-in implements
/// (docs/adding-a-tracker.md shows a whole one).
///
/// One object serves one run and one start, from one thread: a restart is a new object.
class Tracker {
 public:
  virtual ~Tracker() = default;

  /// The target is in `frame` at `box`. Called once, before any `track`.
  /// Throws Error if the box or the picture is one it cannot take.
  virtual void start(const Frame& frame, const Box& box) = 0;

  /// Where the target is in `frame`, the next one that was delivered; nothing says "it is not there"
  /// (a declared loss). A wrong place is a silent loss, which is something else.
  virtual std::optional<Sighting> track(const Frame& frame) = 0;

  /// A hint, before `track`: the target is thought to be at `prior`, give or take `sigma_px`. Optional; a
  /// tracker's registry entry says whether it honours the hint.
  virtual void expect(const Box& prior, double sigma_px) { (void)prior, (void)sigma_px; }
};

}  // namespace relock
