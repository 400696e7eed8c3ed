#pragma once

#include <optional>

#include "core/image.h"
#include "core/sighting.h"

namespace relock {

/// Finds targets in single pictures. This is one of the two interfaces a plug-in implements
/// (docs/adding-a-detector.md shows a whole one).
///
/// One object serves one run, from one thread. It may keep buffers between calls, never answers:
/// `detect` of a picture gives the same result whatever was shown before.
class Detector {
 public:
  virtual ~Detector() = default;

  /// All targets in `image`, best first; an empty vector says "none".
  /// `where`: look only here if given (a hint from a tracker, px); a detector may look further.
  /// Throws Error if the picture's size or format is one it cannot take.
  virtual Sightings detect(const Image& image, const std::optional<Box>& where = {}) = 0;
};

}  // namespace relock
