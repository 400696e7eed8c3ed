#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/frame.h"
#include "core/sighting.h"

namespace relock {

/// What became of a recorded frame on its way to the method.
enum class Delivery : std::uint8_t {
  delivered,
  dropped,  ///< missing from the delivery: injected, or lost in transport
  skipped,  ///< real-time replay: the method was busy
};

/// What a method said of one recorded frame.
struct FrameReport {
  Delivery delivery = Delivery::delivered;
  std::vector<std::size_t> given = {};  ///< targets whose true box the method was handed here, rising
  Sightings sightings = {};             ///< empty unless delivered
  /// Delivered, but not for these targets, rising: the protocol does not show the method the frame (before the
  /// anchor of a run; protocol vot, between a failure and the start after it). Such a target is NotStarted here.
  std::vector<std::size_t> withheld = {};
};

/// All that a method said of a recording: with the Recording, everything that scores are made of.
struct Trajectory {
  std::string method =
      {};  ///< as it would be typed; labels that stem from it are not for it (metrics.md section 6)
  bool reads_codes = false;         ///< whether the method reads codes, as its registry entry declares
  std::vector<FrameReport> frames;  ///< one for every recorded frame
  /// For each target the first frame on which it is judged (or Given); before it, or for ever without one, it
  /// is NotStarted. A method that takes no boxes is judged from the frame after the others' start.
  std::vector<std::optional<FrameIndex>> judged_from;
  /// For each target the first frame for which a crash or a time-out left no answer.
  std::vector<std::optional<FrameIndex>> failed_from;
};

}  // namespace relock
