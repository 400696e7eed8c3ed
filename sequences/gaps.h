#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/schedule.h"
#include "core/time.h"

namespace relock {

/// A pattern of frames lost on the way (metrics.md section 7). Patterns count in slots, the recording's own
/// gaps included: a slot that was not recorded has nothing to lose.
///
///   none                  as recorded
///   paper                 one interval in twenty spans 4 slots (30 Hz: 0.13 s)
///   paper-6s              one interval in twenty spans 4 slots, the others 1 to 3; 1.8 on average (60 ms)
///   gaps(n,p)             an interval spans n slots with probability p, else one: paper is gaps(4,0.05)
///   bernoulli(p)          each slot is lost with probability p
///   gilbert-elliott(p,r)  slots are lost in bursts: one begins with probability p, ends with probability r
///   periodic(n,k)         of every n slots the last k are lost
///   trace(file)           intervals of a real camera: a CSV of timestamp_ns, begun where the seed says
///   fps(n)                the first frame at or after every 1/n s
class GapPattern {
 public:
  /// Throws Error that shows the patterns when `text` is none of them or a number is out of range.
  static GapPattern parse(std::string_view text);

  /// As it would be typed.
  const std::string& text() const { return text_; }

  /// Which frames arrive. The same seed gives the same, everywhere. Frames in `kept` are never lost (start
  /// frames are such).
  Schedule apply(std::span<const Time> captured, Duration period, std::uint64_t seed,
                 std::span<const FrameIndex> kept) const;

 private:
  enum class Kind { none, paper, paper_6s, gaps, bernoulli, gilbert_elliott, periodic, trace, fps };

  std::string text_;
  Kind kind_ = Kind::none;
  double a_ = 0, b_ = 0;
  std::vector<std::int64_t> intervals_;  // trace: in slots of the trace's own nominal period
};

}  // namespace relock
