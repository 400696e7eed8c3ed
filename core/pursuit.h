#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/compose.h"
#include "core/picture.h"

// What hybrid and guarded of core/compose.h have in common.

namespace relock {

/// A target followed by a tracker that starts anew wherever a detector saw the target.
class Pursuit {
 public:
  /// A frame that outlives its pixels, for all the targets seen in it.
  struct Kept {
    FrameIndex index;
    Time captured;
    Picture picture;
    explicit Kept(const Frame& frame) : index(frame.index), captured(frame.captured), picture(frame.image) {}
  };

  /// From a given box, at once: what the tracker refuses is thrown.
  void start(const Frame& frame, const Box& box, std::unique_ptr<Tracker> tracker);
  /// The target is at `box` in that frame. The tracker starts there when it is first asked: most detections
  /// are followed by another one, and starting takes long.
  void restart(std::shared_ptr<const Kept> frame, const Box& box);
  /// No place is known any more.
  void give_up();
  /// The tracker's answer; nothing when there is no tracker, or it cannot be started where it was to be.
  std::optional<Sighting> track(const Frame& frame, const TrackerFactory& make_tracker,
                                std::uint64_t& starts);

 private:
  std::unique_ptr<Tracker> tracker_;
  std::shared_ptr<const Kept> from_;
  Box box_;
};

/// A target that looks for its detection.
struct Claimant {
  std::optional<Code> code;
  Box last;
  bool lost = false;  ///< its last answer was nothing: it may be anywhere
};

/// Of each claimant the detection that is it, one to one: by its code, else the nearest whose code does not
/// contradict, in sizes, within 2 unless it is lost.
std::vector<std::optional<std::size_t>> claims(const std::vector<Claimant>& claimants,
                                               const Sightings& detections);

}  // namespace relock
