#pragma once

#include <cstddef>
#include <vector>

namespace relock {

/// Which recorded frames are delivered to the method; the others are `Dropped`.
class Schedule {
 public:
  /// Everything that was recorded.
  explicit Schedule(std::size_t frames) : delivered_(frames, true) {}

  void drop(std::size_t frame) { delivered_.at(frame) = false; }
  void keep(std::size_t frame) { delivered_.at(frame) = true; }
  bool delivered(std::size_t frame) const { return delivered_.at(frame); }
  std::size_t frames() const { return delivered_.size(); }

 private:
  std::vector<bool> delivered_;
};

}  // namespace relock
