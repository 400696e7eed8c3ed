#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "core/tracker.h"

namespace relock {

/// The part of a tracker that is its own. checked_tracker() puts it behind relock's interface, so it may rely
/// on this: `start` is called once, with a picture that is not empty and what startable_box() makes of the
/// box; then `follow`, with pictures of that size, grey or BGR by turns; and nothing more once it has thrown.
class Follower {
 public:
  virtual ~Follower() = default;

  virtual void start(const Image& picture, const Box& box) = 0;
  /// Nothing: the target is not there. So is an outline that is not finite or lies outside of the picture.
  virtual std::optional<Sighting> follow(const Image& picture) = 0;
  /// Tracker::expect, for those that honour it; the prior is well formed.
  virtual void expect(const Box& prior, double sigma_px) { (void)prior, (void)sigma_px; }
};

/// A tracker that keeps every promise of core/tracker.h, whatever the library behind `make` does: everything
/// that is thrown becomes an Error of one sentence that names the tracker, and after a fault the object takes
/// no more frames. `make` is called at once; throws Error when it does.
std::unique_ptr<Tracker> checked_tracker(std::string name,
                                         const std::function<std::unique_ptr<Follower>()>& make);

}  // namespace relock
